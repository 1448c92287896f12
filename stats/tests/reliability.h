// How well answers to the same presentation agree with one another (test and retest), and the most that this noise lets answers
// reach. Participants are the sampled unit: their pairs need not be alike, and intervals come from the jackknife over
// participants (Tukey 1958; Arvesen 1969, Ann Math Stat 40, 2076).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stats/kernels/value.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/t_tests.h"

namespace stats {

/// A value with its 95 % interval.
struct Estimate {
    Value value;
    Interval ci95;
};

/// One participant's first and second ratings of the same presentations.
using RatingPairs = std::vector<std::pair<double, double>>;

struct RatingReliability {
    std::size_t pairs = 0;
    std::size_t participants = 0;  ///< with at least one pair

    /// ICC(2,1), absolute agreement (Shrout and Fleiss 1979), of all pairs. The shift from first to second answers counts as
    /// noise, because nobody knows whether a rating was given early or late. Its interval is made of Fisher's z.
    Estimate icc;
    /// SD of a rating around the participant's own mean for the presentation: sqrt(sum of d^2 / 2n) over the differences d
    /// (Bland and Altman 1996, BMJ 313, 744). Its interval is made of the logarithm.
    Estimate withinSd;
    TTest bias;                       ///< of the participants' mean differences, second - first
    EquivalenceTest biasEquivalence;  ///< of the same means, to 0
    Interval limitsOfAgreement;       ///< mean difference of the pairs -+ 1.96 SD (Bland and Altman 1986, Lancet 327, 307)

    /// The highest correlation of single ratings with anything that holds no noise: sqrt(ICC) (Spearman 1904, Am J Psychol 15,
    /// 72: correction for attenuation). 0 where the ICC is below 0.
    Estimate correlationCeiling;
    /// The highest mean rating. A rendering can at best feel like the highest point of the scale. Normal noise around it is cut
    /// at the end of the scale, which takes the mean of the upper half away: max - withinSd / sqrt(2 pi), the mean of a normal
    /// variable that is censored at its own mean (Tobin 1958, Econometrica 26, 24). It supposes that the noise is that of the
    /// repeated presentations, and that the scale is wider than a few SDs.
    Estimate meanCeiling;
};

/// `participants`: one list each; empty ones are left out. `scaleMax`: the highest point of the scale. `bounds`: of the bias.
/// What needs more pairs or participants is undefined with its reason. Intervals need at least 3 participants.
RatingReliability ratingReliability(std::span<const RatingPairs> participants, double scaleMax, const EquivalenceOptions& bounds);

/// What two choices can be compared by.
enum class ChoicesCompared {
    Answers,   ///< both choices are the same
    Outcomes,  ///< both are right or both wrong: the foils are others the second time, so wrong choices cannot be the same
    Words,     ///< one of two words, such as "same" and "different": who has a habit for one agrees without perceiving anything
};

/// One participant's repeated choices.
struct RepeatedChoices {
    std::size_t pairs = 0;
    std::size_t agreeing = 0;
    std::size_t bothWrong = 0;   ///< of `agreeing`; stays 0 where answers or words are compared
    std::size_t firstWord = 0;   ///< pairs whose first answer is the one of two words; 0 where no words are compared
    std::size_t secondWord = 0;  ///< pairs whose second answer is this word
};

struct ChoiceReliability {
    std::size_t pairs = 0, agreeing = 0, bothWrong = 0;
    std::size_t participants = 0;  ///< with at least one pair
    /// Share of pairs that agree. Wilson's interval; the pairs divided by the design effect of participants where their shares
    /// differ more than chance makes them (Kish 1965; Korn and Graubard 1998, Survey Methodology 24, 193).
    Estimate agreement;
    /// Of answers: (agreement - 1/m) / (1 - 1/m), kappa for alternatives that change from pair to pair, so that no alternative
    /// has a frequency of its own (Brennan and Prediger 1981, Educ Psychol Meas 41, 687).
    /// Of outcomes: the same, but two wrong choices agree by 1/(m - 1) only, as often as foils taken blindly would be the same.
    /// That is the mean product of the two scores corrected for guessing (1 for right, -1/(m - 1) for wrong): 0 for guessers, 1
    /// where all is right, and the share of presentations that are known where all others are guessed. It needs no estimate of
    /// the share of right answers. Scott's pi, which takes chance from that share, is 0 for rare errors at random and has no
    /// value without errors; the guessers' agreement (1 + (m - 1)^2) / m^2 as chance puts a share of 1/2 far below guessers.
    /// A choice that is wrong for a lasting reason looks like a guess here. The interval is Wilson's of the share that agrees
    /// so. It supposes the variance of whole pairs, so that it is too wide rather than too narrow where many are wrong.
    /// Of words: (agreement - chance) / (1 - chance), Cohen's kappa (1960, Educ Psychol Meas 20, 37) with each participant as a
    /// stratum (Barlow, Lai and Azen 1991, Stat Med 10, 1465). Chance comes from the participant's own words: how often the first
    /// answer to one presentation is the second answer to another. That is Cohen's expected agreement without the pairs
    /// themselves, which would hold their agreement, too, and make kappa small where a participant has few pairs. So it takes the
    /// participants with at least two pairs; who has used one word only adds nothing. 0 for any habit without perception, 1 where
    /// all words are the same again. Of few pairs it can lie below -1, the least that endless pairs allow: both parts are
    /// estimated without bias, and an end at -1 would make the mean over studies too high. The interval is that of the jackknife,
    /// made of Fisher's z. There is none where all participants show the same, or where kappa without one of them is not between
    /// -1 and 1.
    Estimate kappa;
    /// The highest share of right answers over the presentations that came twice; those of one condition may be answered with
    /// less noise than those of another. Who chooses alternative j with probability q_j agrees with themselves with the sum of
    /// q_j^2. For a given sum A, the largest q_j is highest where the others are equal: (1 + sqrt((m - 1) (m A - 1))) / m. It
    /// is concave in A, so it bounds the mean over presentations, too (Jensen). Corrected for chance it is sqrt(kappa), as the
    /// correlation of ratings is sqrt(ICC). At agreement of 1/m and below it is 1/m.
    /// Of outcomes, the two alternatives are right and wrong: (1 + sqrt(2 A - 1)) / 2, and 1/2 where A is below 1/2, which is
    /// then chance, as no true A is. It bounds the share of each single alternative, because none is chosen more often than right
    /// or than all wrong ones together; so it holds however wrong choices spread, and is wide where many are wrong. It supposes
    /// that the two answers are independent and equally often right. What other foils change counts as noise.
    /// Of words it is (1 + sqrt(kappa)) / 2, 1/2 where kappa is below 0. Where each word is right equally often, the share of
    /// right answers is 1/2 plus half the difference of the two rates of one word, which is at most twice its SD over
    /// presentations. That SD is sqrt(kappa v) for a word of variance v, which is at most 1/4.
    Estimate shareCeiling;
};

/// `alternatives`: m, at least 2.
ChoiceReliability choiceReliability(std::span<const RepeatedChoices> participants, int alternatives,
                                    ChoicesCompared compared = ChoicesCompared::Answers);

}  // namespace stats
