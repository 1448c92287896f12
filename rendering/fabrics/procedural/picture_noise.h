// Fast, nearly normal noise for pictures: the sum of four 16-bit uniform numbers from one 64-bit draw.
#pragma once

#include <cstdint>

namespace rendering::fabrics {

class NoiseSource {
public:
    explicit NoiseSource(std::uint64_t seed) : m_state(seed) {}

    /// Mean 0, standard deviation 1, range +-3.46.
    float next()
    {
        m_state += 0x9E3779B97F4A7C15ull;
        std::uint64_t h = (m_state ^ (m_state >> 30)) * 0xBF58476D1CE4E5B9ull;
        h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
        h ^= h >> 31;
        const std::uint32_t sum = std::uint32_t(h & 0xFFFF) + std::uint32_t((h >> 16) & 0xFFFF) +
                                  std::uint32_t((h >> 32) & 0xFFFF) + std::uint32_t(h >> 48);
        // Four uniform numbers of width 65536 have the variance 4/12 * 65536^2.
        return (float(sum) - 131070.0f) * (1.0f / 37837.2f);
    }

private:
    std::uint64_t m_state;
};

}  // namespace rendering::fabrics
