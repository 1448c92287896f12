// vis2hap-sound: masking noise and recordings for the participant's headphones. The app starts it when sound is wanted and sends
// it lines on standard input; it answers with the name of the device, or with faults. It ends with its input.
#include <sys/prctl.h>
#include <unistd.h>

#include <QAudioSink>
#include <QCommandLineParser>
#include <QCoreApplication>
#include <QIODevice>
#include <QMediaDevices>
#include <QSocketNotifier>
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/participant/page_lines.h"
#include "study/participant/sound/sound_lines.h"
#include "study/participant/sound/sound_mix.h"
#include "study/participant/sound/wav_sound.h"

namespace {

using namespace study::participant;

constexpr int channels = 2;

void tell(const char* key, const std::string& text)
{
    const std::string line = nlohmann::json{{key, text}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
}

int report(const std::exception& fault, int code)
{
    std::fprintf(stderr, "vis2hap-sound: %s\n", fault.what());
    return code;
}

/// Does what the line says. A recording that cannot be read is left out, and the app hears why.
void obey(const std::string& text, SoundMix& mix)
{
    const LineToSound line = lineToSound(text);
    if (const auto* noise = std::get_if<NoiseLevel>(&line)) return mix.setNoise(static_cast<float>(noise->level));
    mix.silence();
    for (const std::string& file : std::get<PlayFiles>(line).files) try {
            mix.play(soundFromWav(protocols::readWholeFile(file), file));
        } catch (const protocols::Error& fault) {
            tell("fault", fault.what());
        }
}

/// The mix as a stream that the device reads.
class MixStream final : public QIODevice {
public:
    explicit MixStream(SoundMix& mix) : m_mix(mix) { open(QIODevice::ReadOnly); }
    bool isSequential() const override { return true; }
    qint64 bytesAvailable() const override { return 1 << 20; }  // it never ends

protected:
    qint64 readData(char* data, qint64 maxSize) override
    {
        const auto frames = static_cast<std::size_t>(maxSize / (channels * 2));
        m_samples.resize(frames);
        m_mix.fill(m_samples);
        auto* out = reinterpret_cast<qint16*>(data);
        for (const float sample : m_samples)
            for (int channel = 0; channel < channels; ++channel) *out++ = static_cast<qint16>(std::lround(sample * 32767));
        return static_cast<qint64>(frames) * channels * 2;
    }
    qint64 writeData(const char*, qint64) override { return -1; }

private:
    SoundMix& m_mix;
    std::vector<float> m_samples;
};

class InputReader {
public:
    explicit InputReader(SoundMix& mix) : m_mix(mix), m_notifier(STDIN_FILENO, QSocketNotifier::Read)
    {
        QObject::connect(&m_notifier, &QSocketNotifier::activated, &m_notifier, [this] { read(); });
    }

private:
    void read()
    {
        std::array<char, 65536> bytes{};
        const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        if (count <= 0) return QCoreApplication::exit(0);
        try {
            for (const std::string& line : m_lines.take({bytes.data(), static_cast<std::size_t>(count)})) obey(line, m_mix);
        } catch (const protocols::Error& fault) {
            QCoreApplication::exit(report(fault, 1));
        }
    }

    SoundMix& m_mix;
    LineBuffer m_lines;
    QSocketNotifier m_notifier;
};

int playOnDevice()
{
    const QAudioDevice device = QMediaDevices::defaultAudioOutput();
    QAudioFormat format;
    format.setSampleRate(mixRateHz);
    format.setChannelCount(channels);
    format.setSampleFormat(QAudioFormat::Int16);
    if (device.isNull() || !device.isFormatSupported(format))
        throw protocols::environmentFault({"there is no output for sound", "this computer",
                                           "headphones or loudspeakers, 48 kHz stereo",
                                           "connect the headphones, then start the sound again"});
    SoundMix mix;
    MixStream stream(mix);
    QAudioSink sink(device, format);
    constexpr int latencyMs = 100;
    sink.setBufferSize(format.bytesForDuration(latencyMs * 1000));
    sink.start(&stream);
    if (sink.error() != QAudio::NoError)
        throw protocols::environmentFault({"the output for sound cannot be opened", device.description().toStdString(),
                                           "a free output", "close other programs that play sound, then start it again"});
    const InputReader reader(mix);
    tell("ready", device.description().toStdString());
    return QCoreApplication::exec();
}

/// Writes what the lines of the input would sound like: a second after each level of noise, and each list of recordings with half
/// a second after it.
int writeTo(const std::string& file)
{
    SoundMix mix;
    std::vector<float> all;
    const auto more = [&](double seconds) {
        std::vector<float> samples(static_cast<std::size_t>(seconds * mixRateHz));
        mix.fill(samples);
        all.insert(all.end(), samples.begin(), samples.end());
    };
    for (std::string line; std::getline(std::cin, line);) {
        obey(line, mix);
        if (mix.isPlaying()) {
            while (mix.isPlaying()) more(0.01);
            more(0.5);
        } else {
            more(1);
        }
    }
    protocols::writeWholeFile(file, wavOf(all), protocols::Sync::Later);
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // also where the end of the input is not noticed
    ::close_range(3, ~0U, 0);            // files that a parent of the app left open are none of this program's
    std::signal(SIGPIPE, SIG_IGN);
    QCoreApplication app(argc, argv);
    QCommandLineParser parser;
    parser.setApplicationDescription(
        "Masking noise and recordings for the participant's headphones. The app of Vis2Hap starts this "
        "program.");
    parser.addOption({"to", "Write the sound to this WAV file instead of playing it.", "FILE"});
    parser.addHelpOption();
    parser.process(app);
    try {
        return parser.isSet("to") ? writeTo(parser.value("to").toStdString()) : playOnDevice();
    } catch (const protocols::Error& fault) {
        return report(fault, static_cast<int>(fault.exitCode()));
    }
}
