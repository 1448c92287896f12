// Pairs of conditions within one question: is there a difference, and is it small enough to be equivalent?
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/t_tests.h"

namespace reports {

/// Condition `a` stands before `b` in the study's order; differences are a - b.
struct ConditionPair {
    std::string a;
    std::string b;
    bool planned = false;  ///< a contrast of the protocol
};

/// Paired t test of the participants' means over the fabrics, and repetitions, that they answered under both conditions.
struct PairComparison {
    ConditionPair pair;
    stats::TTest test;
    stats::Value pHolm;  ///< Holm's correction over all pairs of the question
};

/// Two one-sided tests of the same means against the bounds of the study.
struct PairEquivalence {
    ConditionPair pair;
    double low = 0;  ///< boundsOf() the pair, scale points
    double high = 0;
    stats::EquivalenceTest test;
    std::string verdict;  ///< "different" counts after Holm's correction
};

/// Bounds of equivalence of a - b: those of the study, which belong to the planned differences with their sign. Where b - a is
/// planned and a - b is not they are mirrored, so that both state the same.
std::pair<double, double> boundsOf(const StudyData& data, const std::string& a, const std::string& b);

/// The pairs, in the order of the study, whose bounds are other than the study's because they were mirrored.
std::vector<ConditionPair> mirroredPairs(const StudyData& data);

/// All pairs of the conditions, in their order; none where comparesAllPairs() is false.
std::vector<PairComparison> comparePairs(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                         AnswersOfMeans over = AnswersOfMeans::Common);

/// The same pairs in the same order; `comparisons` are those of the question.
std::vector<PairEquivalence> testEquivalence(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                             const std::vector<PairComparison>& comparisons,
                                             AnswersOfMeans over = AnswersOfMeans::Common);

/// The means of the participants who have one under both conditions.
using PairedMeansOf = std::function<AnswerCells::PairedMeans(const std::string& a, const std::string& b)>;

/// The same from means that come from elsewhere, such as the numbers of a simulation.
std::vector<PairComparison> comparePairs(const StudyData& data, const PairedMeansOf& meansOf);
std::vector<PairEquivalence> testEquivalence(const StudyData& data, const PairedMeansOf& meansOf,
                                             const std::vector<PairComparison>& comparisons);

}  // namespace reports
