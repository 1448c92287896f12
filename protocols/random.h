// The project's seeded random generator with portable draws: the same seed gives the same integers with every compiler, library
// and build type. std::shuffle and the distributions of the standard library do not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace protocols {

/// xoshiro256** (Blackman & Vigna 2018), seeded through splitmix64.
class Random {
public:
    explicit Random(std::uint64_t seed);

    /// An independent stream for a named purpose, so that a new draw in one place changes no other draw:
    /// Random::stream(seed, "photo/F03/17").
    static Random stream(std::uint64_t seed, std::string_view purpose);

    std::uint64_t next();

    /// Uniform in [0, bound), unbiased (rejection); bound >= 1.
    std::uint64_t below(std::uint64_t bound);

    /// Uniform in [0, 1) on the grid of 2^-53.
    double uniform();
    double uniform(double low, double high);

    /// Standard normal (polar method).
    double normal();

    /// Fisher-Yates.
    template <class T>
    void shuffle(std::vector<T>& items)
    {
        for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
    }

private:
    std::array<std::uint64_t, 4> m_state;
    double m_spareNormal = 0;
    bool m_hasSpare = false;
};

}  // namespace protocols
