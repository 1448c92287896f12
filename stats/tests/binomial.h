// Exact test of a count of successes against a chance level, and intervals for the proportion.
#pragma once

#include "stats/kernels/value.h"

namespace stats {

struct BinomialTest {
    std::string why;  ///< empty when the test exists
    Value estimate;   ///< successes / trials
    Value pGreater;   ///< P(X >= successes) at the chance level
    Value logPGreater;
    Value pLess;  ///< P(X <= successes)
    Value logPTwoSided;
    Value pTwoSided;  ///< probability of all counts at most as likely as the observed one
    Value logPMidGreater;
    Value pMidGreater;  ///< pGreater minus half the probability of the observed count
    Interval clopperPearson;
    Interval wilson;
};

/// Tests successes among trials, each of probability `chance` (0 < chance < 1) under the null hypothesis.
/// Refused with a reason: no trials, more successes than trials, negative counts.
BinomialTest binomialTest(long long successes, long long trials, double chance, double confidence = 0.95);

/// Score interval of a proportion (Wilson 1927).
Interval wilsonInterval(long long successes, long long trials, double confidence = 0.95);

/// Exact interval of a proportion (Clopper and Pearson 1934).
Interval clopperPearsonInterval(long long successes, long long trials, double confidence = 0.95);

}  // namespace stats
