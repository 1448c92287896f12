#include "reports/analysis/study_analysis.h"

#include <algorithm>
#include <utility>

#include "reports/cells/response_time.h"
#include "reports/data/design_limits.h"

namespace reports {
namespace {

/// Ratings that came without a protocol may leave the scale. It is then extended, for all questions that share it.
NumberOnScale extended(const NumberOnScale& scale, const StudyData& data, const AnswerCells& cells)
{
    NumberOnScale wide = scale;
    for (const QuestionInfo& question : data.questions)
        for (const std::string& condition : data.conditions)
            if (scoringOf(question.kind) == Scoring(scale))
                for (const double rating : valuesOf(cells.of(question.id, condition)))
                    wide = {std::min(wide.min, rating), std::max(wide.max, rating)};
    return wide;
}

QuestionFindings findingsOf(const StudyData& data, const AnswerCells& cells, const QuestionInfo& question, Depth depth)
{
    return std::visit(protocols::Overloaded{
                          [&](const RightOrWrong& choice) -> QuestionFindings {
                              return analyseChoices(data, cells, question.id, choice, depth);
                          },
                          [&](const NumberOnScale& scale) -> QuestionFindings {
                              return analyseRatings(data, cells, question.id, extended(scale, data, cells), depth);
                          },
                          [&](const OpenWords&) -> QuestionFindings { return collectWords(data, cells, question.id); },
                      },
                      scoringOf(question.kind));
}

QuestionAnalysis analyseQuestion(const StudyData& data, const AnswerCells& cells, const QuestionInfo& question, Depth depth)
{
    QuestionAnalysis analysis{question, findingsOf(data, cells, question, depth), {}, {}};
    const std::size_t whole = answersPerCellOf(data, question) * data.participants.size() * data.fabrics.size();
    for (const std::string& condition : data.conditions) {
        const auto responses = cells.of(question.id, condition);
        analysis.missing.push_back(whole > responses.size() ? whole - responses.size() : 0);
        if (hasNumbers(question)) analysis.times.push_back(stats::responseTimes(responseTimesOf(responses)));
    }
    return analysis;
}

std::optional<FalseClaimFinding> falseClaimsOf(const StudyData& data, const AnswerCells& cells, const QuestionAnalysis& question,
                                               std::size_t studies)
{
    using Finding = std::optional<FalseClaimFinding>;
    const std::string& id = question.question.id;
    return std::visit(protocols::Overloaded{
                          [&](const ChoiceAnalysis& choices) { return falseClaimsOf(data, cells, id, choices, studies); },
                          [&](const RatingAnalysis& ratings) { return falseClaimsOf(data, cells, id, ratings, studies); },
                          [](const WordedAnalysis&) { return Finding(); },
                      },
                      question.findings);
}

Completeness completenessOf(const StudyData& data, const AnswerCells& cells)
{
    Completeness completeness;
    for (const QuestionInfo& question : data.questions) completeness.present += cells.answered(question.id);
    completeness.expected = data.expectedResponses != 0 ? data.expectedResponses
                                                        : data.answersPerCell * data.participants.size() * data.fabrics.size() *
                                                              data.conditions.size() * data.questions.size();
    completeness.ofEmptyPlaces = std::min(data.expectedOfEmptyPlaces, completeness.missing());
    return completeness;
}

std::vector<ConditionSpeed> firstSpeedOf(const StudyAnalysis& analysis, const StudyData& data)
{
    const auto choices = questionsWith<ChoiceAnalysis>(analysis);
    return choices.empty() ? speedWithoutChoices(data) : choices.front().findings.speed.conditions;
}

OrderEffects orderEffectsOf(const StudyAnalysis& analysis, const StudyData& data, const AnswerCells& cells)
{
    OrderEffects effects;
    if (!knowsOrder(data)) {
        effects.why = "the answers do not say when they were given";
        return effects;
    }
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionClaims* claims = claimsOf(question))
            effects.questions.push_back(orderOf(data, cells, question.question.id, *claims));
    adjustOrderEffects(effects);
    return effects;
}

/// What may be shown before the unblinding. The one place that decides it: the answers end here. The key serves the means only:
/// what it would add to flags and counts of a running session names the catch trials and anchors.
StudyAnalysis analyseBlinded(StudyData data, const AnalysisOptions& options)
{
    StudyAnalysis analysis;
    analysis.depth = options.depth;
    analysis.designLimits = designLimits(data, options.depth);
    analysis.blindedMeans = blindedMeans(data);
    const StudyData known = withoutKey(data);
    const AnswerCells cells(known);
    analysis.flags = qualityFlags(known, cells);
    analysis.screening = screenParticipants(known, cells, analysis.flags);
    analysis.screening.questions.clear();
    analysis.screening.why = leftOutWhileBlinded;
    analysis.order.why = leftOutWhileBlinded;
    analysis.completeness = completenessOf(known, cells);
    // What the first answers of a running session cover would name the fabric of a trial.
    analysis.data = finishedPart(data);
    analysis.plan = comparePlan(analysis);
    analysis.data = std::move(data);
    forgetAnswers(analysis.data);
    if (options.progress) options.progress(1, 1, "done");
    return analysis;
}

}  // namespace

StudyAnalysis analyse(StudyData data, const AnalysisOptions& options)
{
    if (data.blinded) return analyseBlinded(std::move(data), options);
    StudyAnalysis analysis;
    analysis.depth = options.depth;
    const AnswerCells cells(data);
    const int steps = static_cast<int>(data.questions.size()) + 1;
    const auto report = [&](int done, const std::string& step) {
        if (options.progress) options.progress(done, steps, step);
    };
    for (const QuestionInfo& question : data.questions) {
        report(static_cast<int>(analysis.questions.size()), question.id);
        analysis.questions.push_back(analyseQuestion(data, cells, question, options.depth));
    }
    report(steps - 1, options.resimulated > 0 ? "simulating studies like this one" : "participants");
    for (const QuestionAnalysis& question : analysis.questions)
        if (const auto found = falseClaimsOf(data, cells, question, options.resimulated)) analysis.falseClaims.push_back(*found);
    analysis.speed = firstSpeedOf(analysis, data);
    if (!data.touches.empty()) analysis.touch = touchByCondition(data);
    analysis.anchors = anchorsOf(data, cells);
    analysis.order = orderEffectsOf(analysis, data, cells);
    analysis.flags = qualityFlags(data, cells);
    analysis.screening = screenParticipants(data, cells, analysis.flags);
    if (options.depth == Depth::Whole && analysis.screening.why.empty())
        analysis.withoutFlagged =
            std::make_shared<const StudyAnalysis>(analyse(withoutFlagged(data, analysis.screening), {.depth = Depth::Quick}));
    analysis.groups = analyseGroups(data, cells);
    analysis.designLimits = designLimits(data, options.depth);
    analysis.completeness = completenessOf(data, cells);
    analysis.data = std::move(data);
    analysis.plan = comparePlan(analysis);
    report(steps, "done");
    return analysis;
}

const std::vector<PairComparison>& comparisonsOf(const QuestionAnalysis& question)
{
    static const std::vector<PairComparison> none;
    using Comparisons = const std::vector<PairComparison>&;
    return std::visit(protocols::Overloaded{
                          [](const ChoiceAnalysis& choices) -> Comparisons { return choices.comparisons; },
                          [](const RatingAnalysis& ratings) -> Comparisons { return ratings.comparisons; },
                          [](const WordedAnalysis&) -> Comparisons { return none; },
                      },
                      question.findings);
}

const QuestionClaims* claimsOf(const QuestionAnalysis& question)
{
    using Claims = const QuestionClaims*;
    return std::visit(protocols::Overloaded{
                          [](const ChoiceAnalysis& choices) -> Claims { return &choices.claims; },
                          [](const RatingAnalysis& ratings) -> Claims { return &ratings.claims; },
                          [](const WordedAnalysis&) -> Claims { return nullptr; },
                      },
                      question.findings);
}

const QuestionEffects* effectsOf(const QuestionAnalysis& question)
{
    using Effects = const QuestionEffects*;
    return std::visit(protocols::Overloaded{
                          [](const ChoiceAnalysis& choices) -> Effects { return &choices.effects; },
                          [](const RatingAnalysis& ratings) -> Effects { return &ratings.effects; },
                          [](const WordedAnalysis&) -> Effects { return nullptr; },
                      },
                      question.findings);
}

std::string unitOf(const QuestionAnalysis& question)
{
    return std::holds_alternative<ChoiceAnalysis>(question.findings) ? "log odds" : "scale points";
}

const std::vector<PairEquivalence>& equivalencesOf(const QuestionAnalysis& question)
{
    static const std::vector<PairEquivalence> none;
    using Equivalences = const std::vector<PairEquivalence>&;
    return std::visit(protocols::Overloaded{
                          [](const ChoiceAnalysis&) -> Equivalences { return none; },
                          [](const RatingAnalysis& ratings) -> Equivalences { return ratings.equivalences; },
                          [](const WordedAnalysis&) -> Equivalences { return none; },
                      },
                      question.findings);
}

}  // namespace reports
