// Lattice noise of an endless fabric: hashed values at lattice points, interpolated between them. Any place can
// be evaluated alone and always gives the same value. All functions return values in [-1, 1].
#pragma once

#include <cmath>
#include <cstdint>

namespace rendering::fabrics {

/// Mixes a lattice point into 64 well-spread bits (the finaliser of splitmix64).
inline std::uint64_t hashAt(std::uint64_t seed, std::int64_t i, std::int64_t j)
{
    std::uint64_t h =
        seed ^ (std::uint64_t(i) * 0x9E3779B97F4A7C15ull) ^ (std::uint64_t(j) * 0xC2B2AE3D27D4EB4Full + 0x165667B19E3779F9ull);
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
    return h ^ (h >> 31);
}

inline float inUnitRange(std::uint32_t bits) { return float(std::int32_t(bits)) * (1.0f / 2147483648.0f); }

inline float smoothStep(float t) { return t * t * (3 - 2 * t); }

/// Two independent noise values from one evaluation.
struct NoisePair {
    float first;
    float second;
};

/// Noise along yarn number `yarn`; `t` in lattice cells.
inline NoisePair noiseAlong(std::uint64_t seed, std::int64_t yarn, float t)
{
    const float cell = std::floor(t);
    const float blend = smoothStep(t - cell);
    const std::uint64_t a = hashAt(seed, yarn, std::int64_t(cell));
    const std::uint64_t b = hashAt(seed, yarn, std::int64_t(cell) + 1);
    const auto mixed = [blend](std::uint64_t from, std::uint64_t to) {
        return inUnitRange(std::uint32_t(from)) * (1 - blend) + inUnitRange(std::uint32_t(to)) * blend;
    };
    return {mixed(a, b), mixed(a >> 32, b >> 32)};
}

/// Noise over the plane; `x` and `y` in lattice cells.
inline NoisePair noiseAt(std::uint64_t seed, float x, float y)
{
    const float row = std::floor(y);
    const float blend = smoothStep(y - row);
    const NoisePair upper = noiseAlong(seed, std::int64_t(row), x);
    const NoisePair lower = noiseAlong(seed, std::int64_t(row) + 1, x);
    return {upper.first * (1 - blend) + lower.first * blend, upper.second * (1 - blend) + lower.second * blend};
}

}  // namespace rendering::fabrics
