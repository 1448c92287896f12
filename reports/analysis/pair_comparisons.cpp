#include "reports/analysis/pair_comparisons.h"

#include <algorithm>

#include "reports/data/design_limits.h"
#include "stats/tests/multiplicity.h"

namespace reports {
namespace {

constexpr double significanceLevel = 0.05;

bool isPlanned(const StudyData& data, const std::string& a, const std::string& b)
{
    return std::any_of(data.planned.begin(), data.planned.end(), [&](const auto& contrast) {
        return (contrast.first == a && contrast.second == b) || (contrast.first == b && contrast.second == a);
    });
}

/// One of four verdicts. A difference counts as shown where the corrected t test rejects.
std::string verdictOf(stats::EquivalenceTest test, const stats::Value& pHolm)
{
    test.different = pHolm.exists() && *pHolm < significanceLevel;
    return test.verdict();
}

PairedMeansOf meansIn(const AnswerCells& cells, const std::string& question, AnswersOfMeans over)
{
    return
        [&cells, &question, over](const std::string& a, const std::string& b) { return cells.pairedMeans(question, a, b, over); };
}

}  // namespace

std::vector<PairComparison> comparePairs(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                         AnswersOfMeans over)
{
    return comparePairs(data, meansIn(cells, question, over));
}

std::vector<PairEquivalence> testEquivalence(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                             const std::vector<PairComparison>& comparisons, AnswersOfMeans over)
{
    return testEquivalence(data, meansIn(cells, question, over), comparisons);
}

std::vector<PairComparison> comparePairs(const StudyData& data, const PairedMeansOf& meansOf)
{
    std::vector<PairComparison> comparisons;
    std::vector<stats::Value> p;
    if (!comparesAllPairs(data)) return comparisons;
    for (std::size_t i = 0; i < data.conditions.size(); ++i)
        for (std::size_t k = i + 1; k < data.conditions.size(); ++k) {
            const std::string& a = data.conditions[i];
            const std::string& b = data.conditions[k];
            const AnswerCells::PairedMeans means = meansOf(a, b);
            comparisons.push_back({{a, b, isPlanned(data, a, b)}, stats::pairedTTest(means.a, means.b), {}});
            p.push_back(comparisons.back().test.p);
        }
    const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t i = 0; i < comparisons.size(); ++i) comparisons[i].pHolm = holm[i];
    return comparisons;
}

std::vector<PairEquivalence> testEquivalence(const StudyData& data, const PairedMeansOf& meansOf,
                                             const std::vector<PairComparison>& comparisons)
{
    std::vector<PairEquivalence> equivalences;
    const auto [low, high] = data.equivalenceBounds;
    for (const PairComparison& comparison : comparisons) {
        const ConditionPair& pair = comparison.pair;
        const AnswerCells::PairedMeans means = meansOf(pair.a, pair.b);
        const auto test = stats::equivalenceTest(stats::TKind::Paired, means.a, means.b,
                                                 {.low = low, .high = high, .alpha = significanceLevel});
        equivalences.push_back({pair, low, high, test, verdictOf(test, comparison.pHolm)});
    }
    return equivalences;
}

}  // namespace reports
