#include "study/participant/sound/sound_mix.h"

#include <algorithm>
#include <cmath>

#include "study/participant/sound/wav_sound.h"

namespace study::participant {

namespace {

constexpr float loudest = 0.3F;
constexpr float lowered = 0.25F;  ///< share of the noise while a recording plays: 12 dB less
constexpr float fadeS = 0.05F;    ///< time constant of a change of the noise
/// The root mean square of the filtered noise before its gain.
constexpr float pinkRms = 0.152F;

}  // namespace

void SoundMix::setNoise(float level) { m_noise = std::clamp(level, 0.0F, loudest); }

void SoundMix::play(std::vector<float> recording)
{
    if (!recording.empty()) m_queue.push_back(std::move(recording));
}

void SoundMix::silence()
{
    m_queue.clear();
    m_at = 0;
}

/// Pink noise (Kellet's filter of white noise): it masks the hum of a display without the hiss of white noise.
float SoundMix::noiseSample()
{
    m_random ^= m_random << 13;
    m_random ^= m_random >> 17;
    m_random ^= m_random << 5;
    const float white = static_cast<float>(m_random) / 2147483648.0F - 1.0F;
    m_pink[0] = 0.99765F * m_pink[0] + white * 0.0990460F;
    m_pink[1] = 0.96300F * m_pink[1] + white * 0.2965164F;
    m_pink[2] = 0.57000F * m_pink[2] + white * 1.0526913F;
    return (m_pink[0] + m_pink[1] + m_pink[2] + white * 0.1848F) * 0.1F / pinkRms;
}

void SoundMix::fill(std::span<float> samples)
{
    const float approach = 1 - std::exp(-1 / (fadeS * mixRateHz));
    for (float& sample : samples) {
        const float wanted = m_noise * (isPlaying() ? lowered : 1.0F);
        m_gain += (wanted - m_gain) * approach;
        float heard = m_gain * noiseSample();
        if (isPlaying()) {
            heard += m_queue.front()[m_at];
            if (++m_at == m_queue.front().size()) {
                m_queue.pop_front();
                m_at = 0;
            }
        }
        sample = std::clamp(heard, -1.0F, 1.0F);
    }
}

}  // namespace study::participant
