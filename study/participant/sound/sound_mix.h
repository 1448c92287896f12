// What the participant hears: masking noise, and recordings one after another, during which the noise is lowered. Holds no
// device.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace study::participant {

class SoundMix {
public:
    /// Root mean square of the noise, 0 (off) to 0.3 of full scale. It fades over about 0.1 s.
    void setNoise(float level);
    /// Plays the recording after those that still play. Samples at mixRateHz.
    void play(std::vector<float> recording);
    /// Plays no more recordings; the noise goes on.
    void silence();
    bool isPlaying() const { return !m_queue.empty(); }

    /// The next samples, each from -1 to 1.
    void fill(std::span<float> samples);

private:
    float noiseSample();

    std::deque<std::vector<float>> m_queue;
    std::size_t m_at = 0;  ///< in the first recording of the queue
    float m_noise = 0;     ///< wanted
    float m_gain = 0;      ///< present
    float m_pink[3] = {};
    std::uint32_t m_random = 0x9E3779B9;
};

}  // namespace study::participant
