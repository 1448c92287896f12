// Sensitivity d' of an m-alternative forced choice: the observer chooses the largest of m independent normal
// variables, one of which is shifted by d' (Green and Swets 1966).
#pragma once

#include "stats/kernels/value.h"

namespace stats {

struct ChoiceSensitivity {
    std::string why;  ///< empty when there is a proportion
    Value proportionCorrect;
    Value discriminators;  ///< share of choices that were not guessed, (p - 1/m) / (1 - 1/m); 0 below chance
    Value dPrime;          ///< 0 at or below chance; infinity when every choice was correct
    Value seDPrime;        ///< delta method; undefined below chance and when every choice was correct
};

/// Sensitivity from `correct` of `trials` choices among `alternatives` >= 2. Refused with a reason: no trials,
/// counts that are negative or exceed the trials.
ChoiceSensitivity forcedChoice(long long correct, long long trials, int alternatives);

/// The d' at which the probability of a correct choice is `proportion`: 0 at or below chance, infinity at 1. It increases with
/// the proportion, so that the ends of an interval of the proportion give those of d'. Refused with a reason outside [0, 1].
Value dPrimeAt(double proportion, int alternatives);

}  // namespace stats
