// A small deterministic stream of numbers for property tests. Not a test by itself.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// SplitMix64, a mixed Weyl sequence.
class Stream {
public:
    explicit Stream(std::uint64_t seed) : m_state(seed) {}

    /// Between 0 and 1.
    double next()
    {
        m_state += 0x9E3779B97F4A7C15U;
        std::uint64_t z = m_state;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) / 9007199254740992.0;
    }

    std::vector<double> numbers(std::size_t n)
    {
        std::vector<double> result(n);
        for (double& x : result) x = next();
        return result;
    }

    /// Ratings in tenths, at most 2 from the centre.
    std::vector<double> ratings(std::size_t n, double centre)
    {
        std::vector<double> result(n);
        for (double& x : result) x = std::round((centre + 4 * (next() - 0.5)) * 10) / 10;
        return result;
    }

    template <typename T>
    void shuffle(std::vector<T>& x)
    {
        for (std::size_t i = x.size(); i-- > 1;)
            std::swap(x[i], x[static_cast<std::size_t>(next() * static_cast<double>(i + 1))]);
    }

private:
    std::uint64_t m_state;
};

inline bool near(double a, double b, double relative)
{
    return std::fabs(a - b) <= relative * std::fmax(std::fabs(a), std::fabs(b));
}
