#include "protocols/random.h"

#include <sys/random.h>

#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

/// splitmix64 (Steele, Lea & Flood 2014): advances `state` and returns a mixed value.
std::uint64_t splitmix64(std::uint64_t& state)
{
    state += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/// FNV-1a, 64 bit.
std::uint64_t fnv1a(std::string_view text)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3ULL;
    }
    return hash;
}

std::uint64_t rotatedLeft(std::uint64_t x, int bits) { return (x << bits) | (x >> (64 - bits)); }

}  // namespace

Random::Random(std::uint64_t seed) : m_state{}
{
    for (std::uint64_t& word : m_state) word = splitmix64(seed);
}

Random Random::stream(std::uint64_t seed, std::string_view purpose)
{
    // Mix the seed first, so that neighbouring seeds and similar purposes cannot cancel each other.
    const std::uint64_t mixedSeed = splitmix64(seed);
    std::uint64_t joined = mixedSeed ^ rotatedLeft(fnv1a(purpose), 23);
    return Random(splitmix64(joined));
}

std::uint64_t Random::next()
{
    const std::uint64_t result = rotatedLeft(m_state[1] * 5, 7) * 9;
    const std::uint64_t shifted = m_state[1] << 17;
    m_state[2] ^= m_state[0];
    m_state[3] ^= m_state[1];
    m_state[1] ^= m_state[2];
    m_state[0] ^= m_state[3];
    m_state[2] ^= shifted;
    m_state[3] = rotatedLeft(m_state[3], 45);
    return result;
}

std::uint64_t Random::below(std::uint64_t bound)
{
    assert(bound >= 1 && "a draw needs at least one possible outcome");
    std::uint64_t value = next();
    if (value < bound) {
        // Values below the threshold would make small remainders more frequent, so draw again.
        const std::uint64_t threshold = (0 - bound) % bound;
        while (value < threshold) value = next();
    }
    return value % bound;
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Random::normal()
{
    if (m_hasSpare) {
        m_hasSpare = false;
        return m_spareNormal;
    }
    double u = 0;
    double v = 0;
    double square = 0;
    do {
        u = 2 * uniform() - 1;
        v = 2 * uniform() - 1;
        square = u * u + v * v;
    } while (square >= 1 || square == 0);
    const double scale = std::sqrt(-2 * std::log(square) / square);
    m_spareNormal = v * scale;
    m_hasSpare = true;
    return u * scale;
}

}  // namespace protocols
