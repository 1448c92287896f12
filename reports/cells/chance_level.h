// Whether guessing is right in one of m answers, so that a share correct can be tested against 1/m. Guesses are right in 1/m of
// the choices whatever is preferred, since the right piece lies in every place. Whoever guesses "same" or "different" is right in
// half of the pairs only where half of them were the same. Where 80 % were, the word "same" alone is right in 80 %.
#pragma once

#include <string>
#include <vector>

#include "reports/data/study_data.h"

namespace reports {

/// Why guessing is not right in 1/m of these answers to one question; empty where it is, and where the answers do not show which
/// pairs were the same. Halves may differ by a pair in each condition and instruction, as odd numbers make them in the designs
/// of this program. They may also differ by sqrt(pairs)/4, as after a session that ended early. That moves the share of a guesser
/// by at most a quarter of the standard error of one half.
std::string whyNoChance(const RightOrWrong& scoring, const std::vector<const StudyResponse*>& responses);

}  // namespace reports
