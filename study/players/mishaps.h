// What goes wrong in a simulated session: presentations are voided, answers corrected, steps refused, sessions interrupted, and
// participants withdraw. The draws depend on the seed and the participant alone, so every run and every machine draws the same.
#pragma once

#include <cstdint>
#include <optional>

#include "protocols/ids.h"
#include "protocols/random.h"

namespace study::players {

/// Shares between 0 and 0.5; 0: it never happens.
struct MishapRates {
    double voids = 0;        ///< of presentations, each before an answer; as many again after their last one
    double corrections = 0;  ///< of answers
    double refusals = 0;     ///< of questions before which the operator takes a step that the session refuses
    double pauses = 0;       ///< of questions during which the session is interrupted
    double notes = 0;        ///< of answers after which the operator flags the presentation
    double withdrawals = 0;  ///< of participants

    bool operator==(const MishapRates&) const = default;
};

/// The rates of `vis2hap simulate --mishaps`.
inline constexpr MishapRates usualMishaps{
    .voids = 0.01, .corrections = 0.02, .refusals = 0.02, .pauses = 0.005, .notes = 0.01, .withdrawals = 0.04};

/// The number of stored answers after which the participant withdraws; none for one who stays. `answers`: those of a whole
/// session.
std::optional<int> withdrawalOf(const MishapRates& rates, std::uint64_t seed, const protocols::ParticipantId& participant,
                                int answers);

/// The mishaps of one session in the order of its steps.
class Mishaps {
public:
    Mishaps(const MishapRates& rates, std::uint64_t seed, const protocols::ParticipantId& participant, int answers);

    const MishapRates& rates() const { return m_rates; }
    bool withdrawsAfter(int answersStored) const { return m_withdrawal && answersStored >= *m_withdrawal; }
    /// Draws whether something of this rate happens now.
    bool happens(double rate) { return rate > 0 && m_random.uniform() < rate; }

private:
    MishapRates m_rates;
    std::optional<int> m_withdrawal;
    protocols::Random m_random;
};

}  // namespace study::players
