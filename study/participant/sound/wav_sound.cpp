#include "study/participant/sound/wav_sound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "protocols/files/errors.h"

namespace study::participant {

namespace {

constexpr const char* expectedWav = "a WAV file with PCM samples of 16 bits, one or two channels";

protocols::Error noSound(const std::string& what, const std::string& where)
{
    return protocols::badInput({what, where, expectedWav, "convert it, for example with `sox IN -b 16 OUT.wav`"});
}

std::uint32_t numberAt(std::string_view bytes, std::size_t at, std::size_t size)
{
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i)
        number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return number;
}

struct WavFormat {
    int channels = 0;
    int rateHz = 0;
};

WavFormat formatIn(std::string_view chunk, const std::string& where)
{
    constexpr std::uint32_t pcm = 1, extensible = 0xFFFE;
    if (chunk.size() < 16) throw noSound("the format of the recording is cut", where);
    const std::uint32_t tag = numberAt(chunk, 0, 2);
    const bool isPcm = tag == pcm || (tag == extensible && chunk.size() >= 26 && numberAt(chunk, 24, 2) == pcm);
    const WavFormat format{static_cast<int>(numberAt(chunk, 2, 2)), static_cast<int>(numberAt(chunk, 4, 4))};
    if (!isPcm || numberAt(chunk, 14, 2) != 16) throw noSound("the recording has other samples", where);
    if (format.channels < 1 || format.channels > 2) throw noSound("the recording has other channels", where);
    if (format.rateHz < 8000 || format.rateHz > 192000) throw noSound("the recording has a rate out of 8 to 192 kHz", where);
    return format;
}

std::vector<float> monoOf(std::string_view data, int channels)
{
    const std::size_t frameBytes = 2 * static_cast<std::size_t>(channels);
    std::vector<float> mono;
    mono.reserve(data.size() / frameBytes);
    for (std::size_t at = 0; at + frameBytes <= data.size(); at += frameBytes) {
        int sum = 0;
        for (int channel = 0; channel < channels; ++channel)
            sum += static_cast<std::int16_t>(numberAt(data, at + 2 * static_cast<std::size_t>(channel), 2));
        mono.push_back(static_cast<float>(sum) / static_cast<float>(32768 * channels));
    }
    return mono;
}

/// Linear interpolation: good enough for speech under noise.
std::vector<float> atMixRate(const std::vector<float>& samples, int rateHz)
{
    if (rateHz == mixRateHz || samples.empty()) return samples;
    const double step = static_cast<double>(rateHz) / mixRateHz;
    std::vector<float> resampled(std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(samples.size()) / step)));
    for (std::size_t i = 0; i < resampled.size(); ++i) {
        const double at = static_cast<double>(i) * step;
        const auto before = std::min(static_cast<std::size_t>(at), samples.size() - 1);
        const auto after = std::min(before + 1, samples.size() - 1);
        const auto share = static_cast<float>(at - static_cast<double>(before));
        resampled[i] = samples[before] * (1 - share) + samples[after] * share;
    }
    return resampled;
}

void append(std::string& bytes, std::uint32_t number, int size)
{
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(number >> (8 * i)));
}

}  // namespace

std::vector<float> soundFromWav(std::string_view bytes, const std::string& where)
{
    if (bytes.size() > largestWav) throw noSound("the recording is larger than 32 MiB", where);
    if (bytes.size() < 12 || bytes.substr(0, 4) != "RIFF" || bytes.substr(8, 4) != "WAVE")
        throw noSound("this is no WAV file", where);
    WavFormat format;
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::string_view kind = bytes.substr(at, 4);
        const std::size_t size = numberAt(bytes, at + 4, 4);
        if (size > bytes.size() - at - 8) throw noSound("the recording is cut", where);
        const std::string_view chunk = bytes.substr(at + 8, size);
        if (kind == "fmt ") format = formatIn(chunk, where);
        if (kind == "data") {
            if (format.channels == 0) throw noSound("the recording names no format before its samples", where);
            std::vector<float> sound = atMixRate(monoOf(chunk, format.channels), format.rateHz);
            if (sound.empty()) throw noSound("the recording has no samples", where);
            return sound;
        }
        at += 8 + size + size % 2;  // chunks begin at even places
    }
    throw noSound("the recording has no samples", where);
}

std::string wavOf(const std::vector<float>& samples)
{
    const auto dataBytes = static_cast<std::uint32_t>(2 * samples.size());
    std::string bytes = "RIFF";
    append(bytes, 36 + dataBytes, 4);
    bytes += "WAVEfmt ";
    append(bytes, 16, 4);
    append(bytes, 1, 2);
    append(bytes, 1, 2);
    append(bytes, mixRateHz, 4);
    append(bytes, 2 * mixRateHz, 4);
    append(bytes, 2, 2);
    append(bytes, 16, 2);
    bytes += "data";
    append(bytes, dataBytes, 4);
    for (const float sample : samples)
        append(bytes, static_cast<std::uint32_t>(std::lround(std::clamp(sample, -1.0F, 1.0F) * 32767)), 2);
    return bytes;
}

}  // namespace study::participant
