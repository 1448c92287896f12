#include "reports/analysis/rating_analysis.h"

#include <algorithm>
#include <map>

#include "reports/cells/crossed_answers.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"

namespace reports {
namespace {

/// Whether every participant has equally many cells, and every cell equally many ratings.
bool areBalanced(const std::vector<AnswerCells::CellMean>& cells)
{
    std::map<std::size_t, std::size_t> counts;
    for (const AnswerCells::CellMean& cell : cells) {
        ++counts[cell.participant];
        if (cell.answers != cells.front().answers) return false;
    }
    return std::ranges::all_of(counts, [&](const auto& count) { return count.second == counts.begin()->second; });
}

ConditionRatings analyseCondition(const AnswerCells& cells, const std::string& question, const std::string& condition)
{
    const std::vector<double> ratings = valuesOf(cells.of(question, condition));
    const std::vector<double> means = cells.participantMeans(question, condition);
    ConditionRatings result;
    result.ratings = ratings.size();
    result.mean = stats::meanOf(ratings);
    result.sd = stats::describe(ratings).sd;
    result.participants = means.size();
    // Both are the same number for balanced ratings; only rounding could tell them apart.
    result.meanOfParticipants = areBalanced(cells.cellMeans(question, condition)) ? result.mean : stats::meanOf(means);
    result.ci95 = stats::describe(means).ci95;
    if (means.size() < 2)
        result.ci95.low = result.ci95.high = stats::Value::undefined("needs the means of at least 2 participants");
    return result;
}

/// Repetitions of a participant are averaged first.
std::vector<stats::Value> meansByFabric(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                        const std::string& condition)
{
    std::map<std::string, std::vector<double>> ratings;
    for (const AnswerCells::CellMean& cell : cells.cellMeans(question, condition))
        ratings[cell.first->fabric].push_back(cell.mean);
    std::vector<stats::Value> means;
    for (const std::string& fabric : data.fabrics) means.push_back(stats::meanOf(ratings[fabric]));
    return means;
}

std::vector<ParticipantMeans> meansOfParticipants(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    std::vector<ParticipantMeans> rows;
    for (const std::string& participant : cells.participants()) {
        rows.push_back({participant, {}});
        for (const std::string& condition : data.conditions)
            rows.back().means.push_back(cells.participantMean(question, condition, participant));
    }
    return rows;
}

std::optional<AnsweredFabricTests> testsOverAnswered(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    if (!cells.haveUnequalAnswers(question)) return std::nullopt;
    const AnswerCells::CompleteBlocks blocks = cells.completeBlocks(question, AnswersOfMeans::All);
    AnsweredFabricTests tests;
    tests.completeParticipants = blocks.participants;
    tests.anova = stats::repeatedMeasuresAnova(blocks.table);
    tests.friedman = stats::friedmanTest(blocks.table);
    tests.comparisons = comparePairs(data, cells, question, AnswersOfMeans::All);
    tests.equivalences = testEquivalence(data, cells, question, tests.comparisons, AnswersOfMeans::All);
    return tests;
}

}  // namespace

bool haveUnequalCounts(const RatingAnalysis& ratings)
{
    return std::ranges::any_of(ratings.conditions, [](const ConditionRatings& one) {
        return one.mean.exists() && one.meanOfParticipants.exists() && *one.mean != *one.meanOfParticipants;
    });
}

RatingAnalysis analyseRatings(const StudyData& data, const AnswerCells& cells, const std::string& question,
                              const NumberOnScale& scale, Depth depth)
{
    RatingAnalysis analysis;
    analysis.scale = scale;
    const AnswerCells::CompleteBlocks blocks = cells.completeBlocks(question);
    analysis.completeParticipants = blocks.participants;
    analysis.participants = meansOfParticipants(data, cells, question);
    analysis.anova = stats::repeatedMeasuresAnova(blocks.table);
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        analysis.conditions.push_back(analyseCondition(cells, question, data.conditions[i]));
        analysis.conditions.back().byFabric = meansByFabric(data, cells, question, data.conditions[i]);
        analysis.conditions.back().withinHalfWidth = analysis.anova.moreyHalfWidths[i];
    }
    analysis.friedman = stats::friedmanTest(blocks.table);
    const stats::CrossedStudy answers = crossedCells(data, cells, question);
    analysis.model = stats::fitRatings(answers);
    analysis.comparisons = comparePairs(data, cells, question);
    analysis.equivalences = testEquivalence(data, cells, question, analysis.comparisons);
    analysis.overAnswered = testsOverAnswered(data, cells, question);
    analysis.claims = claimsOf(data, cells, question, std::nullopt, analysis.anova, analysis.model, depth);
    analysis.modelContrasts = modelContrasts(data, analysis.model);
    analysis.leaveOneFabricOut = leaveOneFabricOut(data, answers, analysis.model, depth);
    analysis.effects = ratingEffects(data, cells, question, analysis.claims, analysis.anova, answers, analysis.model);
    analysis.ordinal = ordinalRatings(crossedAnswers(data, cells, question), scale, depth);
    return analysis;
}

}  // namespace reports
