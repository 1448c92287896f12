#include "reports/analysis/quality_flags.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "protocols/files/number_text.h"
#include "reports/cells/response_time.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/binomial.h"

namespace reports {
namespace {

/// Share of one rating from which a participant is flagged, by question; above 1 on a scale of 1 or 2 steps.
using SameRatingLimits = std::map<std::string, double>;

/// One participant's answers under examination.
struct Examination {
    const StudyData& data;
    const AnswerCells& cells;
    const QualityRules& rules;
    const SameRatingLimits& sameRating;
    const std::string& participant;
    std::vector<QualityFlag>& flags;

    std::vector<const StudyResponse*> answers(const QuestionInfo& question) const
    {
        return cells.ofParticipant(question.id, participant);
    }
    void flag(FlagKind kind, const std::string& why) const { flags.push_back({participant, kind, why}); }
};

bool isRating(const QuestionInfo& question) { return std::holds_alternative<NumberOnScale>(scoringOf(question.kind)); }

bool isAtLeast(std::size_t part, double share, std::size_t whole)
{
    return static_cast<double>(part) >= share * static_cast<double>(whole);
}

/// The value that occurs most often; the smallest of several.
template <class Key>
std::pair<Key, std::size_t> favouriteOf(const std::map<Key, std::size_t>& counts)
{
    return *std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
}

void flagMissing(const Examination& one)
{
    std::string parts;
    for (const QuestionInfo& question : one.data.questions) {
        const std::size_t whole = answersPerCellOf(one.data, question) * one.data.conditions.size() * one.data.fabrics.size();
        const std::size_t present = one.answers(question).size();
        if (present < whole)
            parts += (parts.empty() ? "" : ", ") + question.id + ": " + std::to_string(whole - present) + " of " +
                     std::to_string(whole);
    }
    if (!parts.empty()) one.flag(FlagKind::MissingAnswers, "answers missing: " + parts);
}

void flagFast(const Examination& one)
{
    std::vector<double> seconds;
    for (const QuestionInfo& question : one.data.questions)
        if (hasNumbers(question))
            for (const double s : responseTimesOf(one.answers(question))) seconds.push_back(s);
    const auto fast = static_cast<std::size_t>(
        std::count_if(seconds.begin(), seconds.end(), [&](double s) { return s < one.rules.tooFastSeconds; }));
    const auto n = static_cast<double>(seconds.size());
    if (seconds.size() >= one.rules.fewestAnswers && static_cast<double>(fast) > one.rules.tooFastShare * n)
        one.flag(FlagKind::TooFast, std::to_string(fast) + " of " + std::to_string(seconds.size()) + " answers (" +
                                        percentText(static_cast<double>(fast), n) + ") came within " +
                                        protocols::shortest(one.rules.tooFastSeconds) + " s of the touch");
}

/// Different numbers in all answers to a question; no more than `enough` are counted.
std::size_t differentRatings(const StudyData& data, const std::string& question, double enough)
{
    std::set<double> different;
    for (const auto* responses : {&data.responses, &data.catchResponses, &data.mismatchedResponses, &data.repeatedResponses})
        for (const StudyResponse& response : *responses) {
            if (response.question != question) continue;
            if (const auto* rated = std::get_if<RatedAnswer>(&response.content)) different.insert(rated->rating);
            if (static_cast<double>(different.size()) >= enough) return different.size();
        }
    return different.size();
}

/// Numbers that participants could give. A file without a protocol states no steps: there the numbers that all participants
/// together gave count.
std::size_t stepsOf(const StudyData& data, const QuestionInfo& question, double enough)
{
    const bool isStated = data.plannedDesign &&
                          std::ranges::find(data.plannedDesign->questions, question.id) != data.plannedDesign->questions.end();
    if (!isStated) return differentRatings(data, question.id, enough);
    const protocols::RatingScale& scale = std::get<protocols::Rating>(question.kind).scale;
    return static_cast<std::size_t>((scale.max.value - scale.min.value) / std::max(scale.step.value, 1)) + 1;
}

SameRatingLimits sameRatingLimits(const StudyData& data, const QualityRules& rules)
{
    SameRatingLimits limits;
    for (const QuestionInfo& question : data.questions) {
        if (!std::holds_alternative<protocols::Rating>(question.kind)) continue;
        const std::size_t steps = stepsOf(data, question, rules.sameRatingSteps / rules.sameRatingShare);
        limits[question.id] =
            std::max(rules.sameRatingShare, rules.sameRatingSteps / static_cast<double>(std::max<std::size_t>(steps, 1)));
    }
    return limits;
}

void flagStraightLining(const Examination& one)
{
    for (const QuestionInfo& question : one.data.questions) {
        const std::vector<double> ratings = valuesOf(one.answers(question));
        const auto limit = one.sameRating.find(question.id);
        if (limit == one.sameRating.end() || ratings.size() < one.rules.fewestAnswers) continue;
        std::map<double, std::size_t> counts;
        for (const double rating : ratings) ++counts[rating];
        const auto [favourite, times] = favouriteOf(counts);
        if (isAtLeast(times, limit->second, ratings.size()))
            one.flag(FlagKind::StraightLining, question.id + ": " + std::to_string(times) + " of " +
                                                   std::to_string(ratings.size()) + " ratings are " +
                                                   protocols::shortest(favourite));
    }
}

void flagSameAcross(const Examination& one)
{
    std::map<std::tuple<std::string, std::string, std::string>, std::vector<double>> byPresentation;
    std::size_t questions = 0;
    for (const QuestionInfo& question : one.data.questions) {
        if (!isRating(question)) continue;
        ++questions;
        for (const StudyResponse* response : one.answers(question))
            byPresentation[{response->condition, response->fabric, response->repetition}].push_back(valuesOf({response}).front());
    }
    std::size_t whole = 0;
    std::size_t same = 0;
    for (const auto& [place, ratings] : byPresentation) {
        if (ratings.size() != questions) continue;
        ++whole;
        same += std::equal(ratings.begin() + 1, ratings.end(), ratings.begin()) ? 1 : 0;
    }
    if (questions > 1 && whole >= one.rules.fewestAnswers && isAtLeast(same, one.rules.sameAcrossShare, whole))
        one.flag(FlagKind::SameAcrossQuestions,
                 std::to_string(same) + " of " + counted(whole, "presentation") + " got the same number for every question");
}

/// "tray slot B", or the word of a same/different answer.
std::string slotName(const ChosenAnswer& choice)
{
    const std::string answer = choice.answer.value_or("");
    if (answer == "same" || answer == "different") return "the answer \"" + answer + "\"";
    return "tray slot " + std::string(1, static_cast<char>('A' + *choice.slot));
}

void flagSlotBias(const Examination& one)
{
    for (const QuestionInfo& question : one.data.questions) {
        const Scoring scoring = scoringOf(question.kind);
        const auto* choice = std::get_if<RightOrWrong>(&scoring);
        if (choice == nullptr || choice->alternatives < 2) continue;
        std::map<int, std::size_t> counts;
        std::map<int, std::string> names;
        std::size_t trials = 0;
        for (const StudyResponse* response : one.answers(question))
            if (const auto* given = std::get_if<ChosenAnswer>(&response->content); given != nullptr && given->slot) {
                ++counts[*given->slot];
                names[*given->slot] = slotName(*given);
                ++trials;
            }
        if (trials < one.rules.fewestAnswers) continue;
        const auto [favourite, times] = favouriteOf(counts);
        if (choice->isSameDifferent) {
            if (times == trials)
                one.flag(FlagKind::SlotBias,
                         question.id + ": " + names[favourite] + " was given in all " + std::to_string(trials) + " trials");
            continue;
        }
        const auto test =
            stats::binomialTest(static_cast<long long>(times), static_cast<long long>(trials), 1.0 / choice->alternatives);
        const double p = std::min(1.0, *test.pGreater * choice->alternatives);
        if (p < one.rules.slotBiasP)
            one.flag(FlagKind::SlotBias, question.id + ": " + names[favourite] + " was chosen in " + std::to_string(times) +
                                             " of " + std::to_string(trials) + " trials (p " + (p < 0.001 ? "" : "= ") +
                                             pText(p) + ")");
    }
}

/// One participant's ratings in one question.
struct RatedPresentations {
    double scaleLength = 1;
    std::vector<double> low, renderings;  ///< `low`: of blank glass, or of mismatches
};

/// Only questions that have ratings of both kinds: other questions ask for something else.
std::vector<RatedPresentations> ratingsByQuestion(const Examination& one, const std::vector<StudyResponse>& low)
{
    std::map<std::string, std::vector<double>> lowRatings;
    for (const StudyResponse& response : low)
        if (const auto* rated = std::get_if<RatedAnswer>(&response.content); rated != nullptr)
            if (response.participant == one.participant) lowRatings[response.question].push_back(rated->rating);
    std::vector<RatedPresentations> byQuestion;
    for (const QuestionInfo& question : one.data.questions) {
        const Scoring scoring = scoringOf(question.kind);
        const auto* scale = std::get_if<NumberOnScale>(&scoring);
        const auto found = lowRatings.find(question.id);
        if (scale == nullptr || found == lowRatings.end()) continue;
        std::vector<double> renderings = valuesOf(one.answers(question));
        if (!renderings.empty()) byQuestion.push_back({scale->max - scale->min, found->second, std::move(renderings)});
    }
    return byQuestion;
}

/// Blank glass, and the image of another fabric, should get lower ratings than the renderings do. The differences of the
/// questions count in lengths of their scales, each as often as there are such ratings.
void flagRatedHigh(const Examination& one, const std::vector<StudyResponse>& low, FlagKind kind, const std::string& what)
{
    std::size_t ratings = 0, renderings = 0;
    double difference = 0;
    for (const RatedPresentations& rated : ratingsByQuestion(one, low)) {
        ratings += rated.low.size();
        renderings += rated.renderings.size();
        difference += static_cast<double>(rated.low.size()) * (*stats::meanOf(rated.low) - *stats::meanOf(rated.renderings)) /
                      rated.scaleLength;
    }
    if (ratings < one.rules.fewestCatchRatings || renderings < one.rules.fewestAnswers) return;
    if (difference >= 0)
        one.flag(kind, counted(ratings, "rating") + " of " + what + " have at least the mean of the renderings' ratings");
}

/// "60 % on 5 steps, 75 % on 4 steps and 100 % on 3 steps".
std::string shortScalesText(const QualityRules& rules)
{
    std::vector<std::string> limits;
    for (int steps = static_cast<int>(std::ceil(rules.sameRatingSteps / rules.sameRatingShare)) - 1;
         steps >= rules.sameRatingSteps; --steps)
        limits.push_back(percentText(rules.sameRatingSteps / steps, 1) + " on " + std::to_string(steps) + " steps");
    return listed(limits);
}

}  // namespace

std::string nameOf(FlagKind kind)
{
    switch (kind) {
        case FlagKind::MissingAnswers:
            return "missing_answers";
        case FlagKind::TooFast:
            return "too_fast";
        case FlagKind::StraightLining:
            return "straight_lining";
        case FlagKind::SameAcrossQuestions:
            return "same_across_questions";
        case FlagKind::SlotBias:
            return "slot_bias";
        case FlagKind::BlankGlassRatedHigh:
            return "blank_glass_rated_high";
        case FlagKind::MismatchRatedHigh:
            return "mismatch_rated_high";
        case FlagKind::VoidedPresentations:
            return "voided_presentations";
    }
    return {};
}

std::vector<QualityFlag> qualityFlags(const StudyData& data, const AnswerCells& cells, const QualityRules& rules)
{
    std::vector<QualityFlag> flags;
    const SameRatingLimits sameRating = sameRatingLimits(data, rules);
    for (const std::string& participant : data.participants) {
        const Examination one{data, cells, rules, sameRating, participant, flags};
        flagMissing(one);
        flagFast(one);
        flagStraightLining(one);
        flagSameAcross(one);
        flagSlotBias(one);
        flagRatedHigh(one, data.catchResponses, FlagKind::BlankGlassRatedHigh, "blank glass (catch trials)");
        flagRatedHigh(one, data.mismatchedResponses, FlagKind::MismatchRatedHigh, "mismatched presentations (another fabric)");
    }
    if (data.voided > 0)
        flags.push_back({std::nullopt, FlagKind::VoidedPresentations,
                         counted(data.voided, "presentation") + (data.voided == 1 ? " was" : " were") +
                             " voided and presented again; answers to them are kept and not analysed"});
    return flags;
}

std::vector<QualityFlag> qualityFlags(const StudyData& data) { return qualityFlags(data, AnswerCells(data)); }

std::string mismatchRule(const QualityRules& rules)
{
    return "mismatch_rated_high: the mean rating of mismatched presentations (another fabric on the tray) is not below the mean "
           "of the other ratings of the same questions. Several scales are joined as for blank glass. It needs at least " +
           std::to_string(rules.fewestCatchRatings) + " such ratings.";
}

std::vector<std::string> ruleSentences(const QualityRules& rules)
{
    const auto percentOf = [](double share) { return percentText(share, 1); };
    return {
        "missing_answers: the participant gave fewer answers than the design asks for.",
        "too_fast: more than " + percentOf(rules.tooFastShare) + " of the timed choices and ratings came within " +
            protocols::shortest(rules.tooFastSeconds) + " s of the first touch.",
        "straight_lining: at least " + percentOf(rules.sameRatingShare) +
            " of the ratings of one question are the same number. Short scales need more: " + shortScalesText(rules) +
            ". Scales of fewer steps flag nobody. Without a protocol, the numbers that all participants gave count as the steps.",
        "same_across_questions: at least " + percentOf(rules.sameAcrossShare) +
            " of the presentations got the same number for every rating question.",
        "Both flags on equal ratings have a known weakness: a participant who feels no difference also gives such ratings.",
        "blank_glass_rated_high: the mean rating of blank glass (catch trials) is not below the mean of the other ratings of the "
        "same questions. Over several scales, differences are divided by the length of the scale. It needs at least " +
            std::to_string(rules.fewestCatchRatings) + " ratings of blank glass.",
        "slot_bias: the participant chose one tray slot more often than 1/m (exact binomial test, p times the number of slots "
        "below " +
            protocols::shortest(rules.slotBiasP) +
            "). A participant may say \"same\" more readily than \"different\"; here only one who always gave the same of both "
            "words is flagged.",
        "voided_presentations: these presentations were invalid and were presented again. Answers to them are kept and not "
        "analysed.",
        "A share is judged from " + std::to_string(rules.fewestAnswers) + " answers on. Flagged data stay in the main analysis.",
    };
}

}  // namespace reports
