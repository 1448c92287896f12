// Whether guessing is right in one of m answers, so that a share correct can be tested against 1/m. Guesses are right in 1/m of
// the choices whatever is preferred, since the right piece lies in every place. Whoever guesses "same" or "different" is right in
// half of the pairs only where half of them were the same. Where 80 % were, the word "same" alone is right in 80 %.
#pragma once

#include <string>
#include <vector>

#include "reports/data/study_data.h"

namespace reports {

/// The pairs of one participant under one condition and instruction. A design halves each such list.
struct PairList {
    long long same = 0, different = 0;

    long long excess() const { return same - different; }
    long long pairs() const { return same + different; }
};

/// Why guessing is not right in half of the answers to these pairs; empty where it is. Halves may differ as designs of this
/// program make them. There an odd list has one pair more or less of the same; only complete studies balance that. The answers
/// that a list lacks may leave more: the longest list counts as complete. Such differences are draws, so their sum may reach 1.5
/// of its standard deviations, and sqrt(pairs) at most. Whoever knows one word only is then not above chance, in trials or in
/// participants. Whatever the lists are, the sum may be 1, or sqrt(pairs)/4: a quarter of the standard error of one half.
std::string whyNotHalved(const std::vector<PairList>& lists);

/// Why guessing is not right in 1/m of these answers to one question; empty where it is, and where the answers do not show which
/// pairs were the same.
std::string whyNoChance(const RightOrWrong& scoring, const std::vector<const StudyResponse*>& responses);

}  // namespace reports
