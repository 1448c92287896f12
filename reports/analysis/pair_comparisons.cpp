#include "reports/analysis/pair_comparisons.h"

#include <algorithm>
#include <utility>

#include "reports/data/design_limits.h"
#include "stats/tests/multiplicity.h"

namespace reports {
namespace {

constexpr double significanceLevel = 0.05;

/// Whether a - b is planned, with this sign.
bool plansDifference(const StudyData& data, const std::string& a, const std::string& b)
{
    return std::ranges::find(data.planned, std::pair(a, b)) != data.planned.end();
}

bool isPlanned(const StudyData& data, const std::string& a, const std::string& b)
{
    return plansDifference(data, a, b) || plansDifference(data, b, a);
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

std::pair<double, double> boundsOf(const StudyData& data, const std::string& a, const std::string& b)
{
    const auto& bounds = data.equivalenceBounds;
    if (plansDifference(data, a, b) || !plansDifference(data, b, a)) return bounds;
    return {0 - bounds.second, 0 - bounds.first};  // not -0, which would be printed
}

std::vector<ConditionPair> mirroredPairs(const StudyData& data)
{
    std::vector<ConditionPair> mirrored;
    if (!comparesAllPairs(data)) return mirrored;
    for (auto a = data.conditions.begin(); a != data.conditions.end(); ++a)
        for (auto b = a + 1; b != data.conditions.end(); ++b)
            if (boundsOf(data, *a, *b) != data.equivalenceBounds) mirrored.push_back({*a, *b, true});
    return mirrored;
}

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
    for (const PairComparison& comparison : comparisons) {
        const ConditionPair& pair = comparison.pair;
        const auto [low, high] = boundsOf(data, pair.a, pair.b);
        const AnswerCells::PairedMeans means = meansOf(pair.a, pair.b);
        const auto test = stats::equivalenceTest(stats::TKind::Paired, means.a, means.b,
                                                 {.low = low, .high = high, .alpha = significanceLevel});
        equivalences.push_back({pair, low, high, test, verdictOf(test, comparison.pHolm)});
    }
    return equivalences;
}

}  // namespace reports
