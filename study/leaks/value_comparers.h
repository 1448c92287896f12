// Ways to compare a value with the values whose class a guesser knows.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

#include "study/leaks/questions.h"
#include "study/leaks/value_parts.h"

namespace study::leaks {

/// The share of each class that has an equal value.
class ByEqualValues {
public:
    ByEqualValues(const KnownTrials& known, const std::vector<int>& values)
    {
        std::vector<double> totals(static_cast<std::size_t>(known.kinds));
        for (std::size_t i = 0; i < known.trials.size(); ++i) {
            const int value = values[known.trials[i]];
            if (value < 0) continue;
            const auto at = static_cast<std::size_t>(value);
            if (m_shares.size() <= at) m_shares.resize(at + 1);
            m_shares[at].resize(totals.size());
            ++m_shares[at][static_cast<std::size_t>(known.classes[i])];
            ++totals[static_cast<std::size_t>(known.classes[i])];
        }
        for (auto& shares : m_shares)
            for (std::size_t kind = 0; kind < shares.size(); ++kind) shares[kind] /= std::max(1.0, totals[kind]);
    }

    double score(int value, int kind) const
    {
        const auto at = static_cast<std::size_t>(value);
        return at >= m_shares.size() || m_shares[at].empty() ? 0 : m_shares[at][static_cast<std::size_t>(kind)];
    }

private:
    std::vector<std::vector<double>> m_shares;  ///< [value][class]
};

/// The distance to the nearest known value of the class.
class ByOrder {
public:
    ByOrder(const KnownTrials& known, const CodedValues& values) : m_known(static_cast<std::size_t>(known.kinds))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i)
            if (values.equal[known.trials[i]] >= 0)
                m_known[static_cast<std::size_t>(known.classes[i])].push_back(values.places[known.trials[i]]);
        for (auto& own : m_known) std::ranges::sort(own);
    }

    double score(double place, int kind) const
    {
        const auto& own = m_known[static_cast<std::size_t>(kind)];
        const auto above = std::ranges::lower_bound(own, place);
        double nearest = std::numeric_limits<double>::max();
        if (above != own.end()) nearest = *above - place;
        if (above != own.begin()) nearest = std::min(nearest, place - *std::prev(above));
        return -nearest;
    }

private:
    std::vector<std::vector<double>> m_known;
};

/// The beginning of a text in words of eight letters.
inline constexpr std::size_t mostLetters = 96;
using Letters = std::array<std::uint64_t, mostLetters / 8>;

inline Letters lettersOf(const std::string& text)
{
    Letters letters{};
    std::memcpy(letters.data(), text.data(), std::min(text.size(), mostLetters));
    return letters;
}

/// Number of equal letters at equal places.
inline int equalLetters(const Letters& a, const Letters& b)
{
    constexpr std::uint64_t low = 0x7f7f7f7f7f7f7f7f, ones = 0x0101010101010101;
    std::uint64_t differences = 0;  // one count in each byte; faster than counting bits
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::uint64_t bits = a[i] ^ b[i];
        differences += ((((bits & low) + low) | bits) >> 7) & ones;
    }
    const int different = static_cast<int>((differences * ones) >> 56);
    return static_cast<int>(mostLetters) - different;
}

/// The most equal letters with a known value of the class.
class ByLetters {
public:
    ByLetters(const KnownTrials& known, const Feature& feature) : m_known(static_cast<std::size_t>(known.kinds))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i)
            if (const auto& value = feature.values[known.trials[i]]; !value.empty())
                m_known[static_cast<std::size_t>(known.classes[i])].push_back(lettersOf(value));
    }

    double score(const std::string& value, int kind) const
    {
        const Letters own = lettersOf(value);
        int best = 0;
        for (const Letters& other : m_known[static_cast<std::size_t>(kind)]) best = std::max(best, equalLetters(own, other));
        return best;
    }

private:
    std::vector<std::vector<Letters>> m_known;
};

/// Log likelihood of all letters, each place taken as independent (naive Bayes).
class ByAllLetters {
public:
    ByAllLetters(const KnownTrials& known, const Feature& feature)
        : m_counts(static_cast<std::size_t>(known.kinds) * mostLetters * letterKinds),
          m_values(static_cast<std::size_t>(known.kinds))
    {
        for (std::size_t i = 0; i < known.trials.size(); ++i) {
            const auto kind = static_cast<std::size_t>(known.classes[i]);
            const auto& value = feature.values[known.trials[i]];
            if (value.empty()) continue;
            ++m_values[kind];
            for (std::size_t at = 0; at < std::min(value.size(), mostLetters); ++at) ++m_counts[cell(kind, at, value[at])];
        }
    }

    double score(const std::string& value, int which) const
    {
        const auto kind = static_cast<std::size_t>(which);
        double sum = 0;
        for (std::size_t at = 0; at < std::min(value.size(), mostLetters); ++at)
            sum += std::log((m_counts[cell(kind, at, value[at])] + 0.5F) / (m_values[kind] + 8));
        return sum;
    }

private:
    static constexpr std::size_t letterKinds = 128;
    static std::size_t cell(std::size_t kind, std::size_t at, char letter)
    {
        return (kind * mostLetters + at) * letterKinds + (static_cast<unsigned char>(letter) & 127U);
    }

    std::vector<float> m_counts;
    std::vector<float> m_values;
};

}  // namespace study::leaks
