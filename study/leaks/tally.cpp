#include "study/leaks/tally.h"

#include <algorithm>
#include <utility>

#include "stats/tests/binomial.h"

namespace study::leaks {

Tally::Tally(std::string attack, std::string what, std::string target)
    : m_guess{std::move(attack), std::move(what), std::move(target)}
{
}

void Tally::beginPart() { m_parts.emplace_back(); }

void Tally::take(const std::vector<double>& scores, std::size_t truth, double chance)
{
    const auto [least, most] = std::ranges::minmax(scores);
    if (!(most > least)) return;
    std::vector<std::size_t> best;
    for (std::size_t i = 0; i < scores.size(); ++i)
        if (scores[i] >= most - 1e-12) best.push_back(i);
    if (m_parts.empty()) beginPart();
    Part& part = m_parts.back();
    part.hits += best[m_random.below(best.size())] == truth;
    ++part.trials;
    part.chances += chance;
}

void Tally::addTo(std::vector<Guess>& guesses)
{
    std::erase_if(m_parts, [](const Part& part) { return part.trials == 0; });
    double chances = 0;
    for (const Part& part : m_parts) {
        m_guess.hits += part.hits;
        m_guess.trials += part.trials;
        chances += part.chances;
    }
    if (m_guess.trials == 0) return;
    m_guess.chance = chances / static_cast<double>(m_guess.trials);
    if (m_guess.chance >= 1) return;
    for (const Part& part : m_parts) {
        const double chance = std::min(1.0, part.chances / static_cast<double>(part.trials));
        const double p = *stats::binomialTest(part.hits, part.trials, chance).pGreater;
        m_guess.p = std::min(m_guess.p, p * static_cast<double>(m_parts.size()));
    }
    guesses.push_back(m_guess);
}

}  // namespace study::leaks
