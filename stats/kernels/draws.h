// Random numbers of simulated studies and of resampling: each study, and each block of resamples, has a stream
// of its own, so that neither the number of threads nor another study changes a draw.
#pragma once

#include <cmath>
#include <cstdint>

namespace stats {

/// SplitMix64 (Steele, Lea and Flood 2014).
class Draws {
public:
    Draws(std::uint64_t seed, std::uint64_t stream) : m_state(mixed(mixed(seed) + stream)) {}

    /// The next 64 bits.
    std::uint64_t bits() { return mixed(m_state += 0x9E3779B97F4A7C15U); }

    /// Between 0 and 1, neither of them.
    double uniform() { return (static_cast<double>(bits() >> 12U) + 0.5) * 0x1p-52; }

    bool happens(double probability) { return uniform() < probability; }

    /// Standard normal (polar method; its second number is not kept, so that each draw stands for itself).
    double normal()
    {
        while (true) {
            const double x = 2 * uniform() - 1;
            const double y = 2 * uniform() - 1;
            const double square = x * x + y * y;
            if (square < 1 && square > 0) return x * std::sqrt(-2 * std::log(square) / square);
        }
    }
    double normal(double sd) { return sd * normal(); }

private:
    static std::uint64_t mixed(std::uint64_t z)
    {
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }

    std::uint64_t m_state;
};

}  // namespace stats
