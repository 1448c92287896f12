#include "study/players/mishaps.h"

#include <algorithm>

namespace study::players {

std::optional<int> withdrawalOf(const MishapRates& rates, std::uint64_t seed, const protocols::ParticipantId& participant,
                                int answers)
{
    if (rates.withdrawals <= 0) return std::nullopt;
    auto random = protocols::Random::stream(seed, "withdrawal of " + participant.value);
    if (random.uniform() >= rates.withdrawals) return std::nullopt;
    return static_cast<int>(random.below(static_cast<std::uint64_t>(std::max(1, answers))));
}

Mishaps::Mishaps(const MishapRates& rates, std::uint64_t seed, const protocols::ParticipantId& participant, int answers)
    : m_rates(rates),
      m_withdrawal(withdrawalOf(rates, seed, participant, answers)),
      m_random(protocols::Random::stream(seed, "mishaps of " + participant.value))
{
}

}  // namespace study::players
