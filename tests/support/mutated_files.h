// Damaged files for fuzzing tests of readers: truncated, with flipped bits, extreme numbers, zero bytes, lost quotes, mixed
// line ends, Latin-1 text, or wrong lengths in headers. The same seed of the generator gives the same files.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "protocols/random.h"

namespace mutated_files {

using protocols::Random;

inline std::size_t placeIn(const std::string& text, Random& random) { return random.below(text.size() + 1); }

inline void cutShort(std::string& text, Random& random) { text.resize(placeIn(text, random)); }

inline void flipBits(std::string& text, Random& random)
{
    for (std::uint64_t count = 1 + random.below(8); count > 0 && !text.empty(); --count) {
        char& byte = text[random.below(text.size())];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << random.below(8)));
    }
}

inline void writeNoise(std::string& text, Random& random)
{
    const std::size_t from = placeIn(text, random), to = std::min(text.size(), from + random.below(24));
    for (std::size_t i = from; i < to; ++i) text[i] = static_cast<char>(random.below(256));
}

inline void insertToken(std::string& text, Random& random)
{
    using namespace std::string_view_literals;
    static constexpr std::string_view tokens[] = {"1e308"sv,
                                                  "-1e308"sv,
                                                  "1e400"sv,
                                                  "nan"sv,
                                                  "inf"sv,
                                                  "-inf"sv,
                                                  "99999999999999999999"sv,
                                                  "-1"sv,
                                                  "1e-320"sv,
                                                  "0x10"sv,
                                                  "1,5"sv,
                                                  "\""sv,
                                                  "\"\""sv,
                                                  "\0"sv,
                                                  "\0\0\0\0"sv,
                                                  "\xB5"sv,
                                                  "\xE4\xF6\xFC"sv,
                                                  "\xEF\xBB\xBF"sv,
                                                  "\xFF\xFE"sv,
                                                  "\r"sv,
                                                  "\n"sv,
                                                  "\r\n"sv,
                                                  "\t"sv,
                                                  ","sv,
                                                  ";"sv,
                                                  "[N]"sv,
                                                  "(mN)"sv};
    text.insert(placeIn(text, random), tokens[random.below(std::size(tokens))]);
}

/// Replaces one number in the text by another.
inline void replaceNumber(std::string& text, Random& random)
{
    static constexpr std::string_view numbers[] = {"0",          "-0", "1e300", "-1e300", "1e-300",
                                                   "4294967296", "-5", "",      "nan",    "1e999"};
    constexpr std::string_view digits = "0123456789.";
    const std::size_t start = text.find_first_of(digits, placeIn(text, random));
    if (start == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of(digits, start), text.size());
    text.replace(start, end - start, numbers[random.below(std::size(numbers))]);
}

/// Overwrites four or eight bytes with an extreme integer, in either byte order.
inline void writeExtremeInteger(std::string& text, Random& random)
{
    static constexpr std::uint64_t extremes[] = {
        0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x10000, 0xFFFFFFFFFFFFFFFF, 0x7FC00000, 0x7F800000};
    std::uint64_t value = extremes[random.below(std::size(extremes))];
    const bool bigEndian = random.below(2) == 1;
    const std::size_t size = random.below(2) == 1 ? 4 : 8, from = placeIn(text, random);
    for (std::size_t i = 0; i < size && from + i < text.size(); ++i)
        text[from + i] = static_cast<char>((value >> (8 * (bigEndian ? size - 1 - i : i))) & 0xFF);
}

inline void loseQuotes(std::string& text, Random& random)
{
    const std::size_t quote = text.find('"', placeIn(text, random));
    if (quote != std::string::npos) text.erase(quote, 1);
}

inline void mixLineEnds(std::string& text, Random& random)
{
    std::string mixed;
    for (const char c : text) {
        if (c == '\r') continue;
        if (c != '\n')
            mixed += c;
        else
            mixed += random.below(3) == 0 ? "\r\n" : random.below(2) == 0 ? "\n" : "\r";
    }
    text = mixed;
}

inline void erasePart(std::string& text, Random& random)
{
    const std::size_t from = placeIn(text, random);
    text.erase(from, random.below(64));
}

inline void repeatPart(std::string& text, Random& random)
{
    const std::size_t from = placeIn(text, random);
    const std::string part = text.substr(from, random.below(256));
    text.insert(placeIn(text, random), part);
}

/// A copy of `seed` after one to four random mutations.
inline std::string mutated(const std::string& seed, Random& random)
{
    static constexpr void (*mutations[])(std::string&, Random&) = {cutShort,      flipBits,      writeNoise,          insertToken,
                                                                   replaceNumber, replaceNumber, writeExtremeInteger, loseQuotes,
                                                                   mixLineEnds,   erasePart,     repeatPart};
    std::string text = seed;
    for (std::uint64_t count = 1 + random.below(4); count > 0; --count)
        mutations[random.below(std::size(mutations))](text, random);
    return text;
}

/// Duration of a fuzzing test, s: the value of VIS2HAP_FUZZ_SECONDS, or `seconds` if it is not set.
inline double fuzzSeconds(double seconds)
{
    const char* wanted = std::getenv("VIS2HAP_FUZZ_SECONDS");
    return wanted != nullptr ? std::max(0.0, std::atof(wanted)) : seconds;
}

}  // namespace mutated_files
