#include "reports/analysis/quality_flags.h"

#include <algorithm>
#include <map>

#include "stats/kernels/decimal_grid.h"
#include "stats/tests/binomial.h"

namespace reports {
namespace {

class Flags {
public:
    void add(const std::string& participant, const std::string& flag, const std::string& why)
    {
        m_flags.push_back(Json{{"participant", participant}, {"flag", flag}, {"why", why}});
    }
    void addForStudy(const std::string& flag, const std::string& why)
    {
        m_flags.push_back(Json{{"participant", nullptr}, {"flag", flag}, {"why", why}});
    }
    Json take() { return std::move(m_flags); }

private:
    Json m_flags = Json::array();
};

std::vector<const Response*> allOf(const StudyData& data, const Cells& cells, const std::string& participant,
                                   const std::string& question)
{
    std::vector<const Response*> result;
    for (const std::string& condition : data.conditions) {
        const auto part = cells.of(question, condition, participant);
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

std::string percent(std::size_t part, std::size_t whole)
{
    return fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 0) + " %";
}

void flagMissing(Flags& flags, const StudyData& data, const Cells& cells, const std::string& participant)
{
    std::string parts;
    const std::size_t whole = data.conditions.size() * data.fabrics.size();
    for (const QuestionInfo& question : data.questions) {
        const std::size_t present = allOf(data, cells, participant, question.id).size();
        if (present < whole)
            parts += (parts.empty() ? "" : ", ") + question.id + ": " + std::to_string(whole - present) + " of " +
                     std::to_string(whole);
    }
    if (!parts.empty()) flags.add(participant, "missing_answers", "answers missing: " + parts);
}

void flagFast(Flags& flags, const StudyData& data, const Cells& cells, const std::string& participant, const QualityRules& rules)
{
    std::vector<double> seconds;
    for (const QuestionInfo& question : data.questions)
        for (const double s : secondsOf(allOf(data, cells, participant, question.id))) seconds.push_back(s);
    const auto fast = static_cast<std::size_t>(
        std::count_if(seconds.begin(), seconds.end(), [&](double s) { return s < rules.tooFastSeconds; }));
    if (seconds.size() >= rules.fewestAnswers &&
        static_cast<double>(fast) > rules.tooFastShare * static_cast<double>(seconds.size()))
        flags.add(participant, "too_fast",
                  std::to_string(fast) + " of " + std::to_string(seconds.size()) + " answers (" + percent(fast, seconds.size()) +
                      ") came within " + shortest(rules.tooFastSeconds) + " s of the touch");
}

void flagStraightLining(Flags& flags, const StudyData& data, const Cells& cells, const std::string& participant,
                        const QualityRules& rules)
{
    for (const QuestionInfo& question : data.questions) {
        const auto ratings = valuesOf(allOf(data, cells, participant, question.id));
        if (question.isChoice || ratings.size() < rules.fewestAnswers) continue;
        std::map<double, std::size_t> counts;
        for (const double rating : ratings) ++counts[rating];
        const auto favourite =
            std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
        if (static_cast<double>(favourite->second) >= rules.sameRatingShare * static_cast<double>(ratings.size()))
            flags.add(participant, "straight_lining",
                      question.id + ": " + std::to_string(favourite->second) + " of " + std::to_string(ratings.size()) +
                          " ratings are " + shortest(favourite->first));
    }
}

void flagSameAcross(Flags& flags, const StudyData& data, const Cells& cells, const std::string& participant,
                    const QualityRules& rules)
{
    std::map<std::pair<std::string, std::string>, std::vector<double>> byPresentation;
    std::size_t questions = 0;
    for (const QuestionInfo& question : data.questions) {
        if (question.isChoice) continue;
        ++questions;
        for (const Response* response : allOf(data, cells, participant, question.id))
            byPresentation[{response->condition, response->fabric}].push_back(*response->rating);
    }
    std::size_t whole = 0;
    std::size_t same = 0;
    for (const auto& [place, ratings] : byPresentation) {
        if (ratings.size() != questions) continue;
        ++whole;
        same += std::equal(ratings.begin() + 1, ratings.end(), ratings.begin()) ? 1 : 0;
    }
    if (questions > 1 && whole >= rules.fewestAnswers &&
        static_cast<double>(same) >= rules.sameAcrossShare * static_cast<double>(whole))
        flags.add(participant, "same_across_questions",
                  std::to_string(same) + " of " + counted(whole, "presentation") + " got the same number for every question");
}

void flagSlotBias(Flags& flags, const StudyData& data, const Cells& cells, const std::string& participant,
                  const QualityRules& rules)
{
    for (const QuestionInfo& question : data.questions) {
        std::map<int, long long> counts;
        long long trials = 0;
        for (const Response* response : allOf(data, cells, participant, question.id))
            if (response->answerSlot) {
                ++counts[*response->answerSlot];
                ++trials;
            }
        if (trials < static_cast<long long>(rules.fewestAnswers) || data.alternativesOf(question.id) < 2) continue;
        const auto favourite =
            std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
        const auto test = stats::binomialTest(favourite->second, trials, 1.0 / data.alternativesOf(question.id));
        const double p = std::min(1.0, *test.pGreater * data.alternativesOf(question.id));
        if (p < rules.slotBiasP)
            flags.add(participant, "slot_bias",
                      question.id + ": tray slot " + std::string(1, static_cast<char>('A' + favourite->first)) +
                          " was chosen in " + std::to_string(favourite->second) + " of " + std::to_string(trials) +
                          " trials (p " + (p < 0.001 ? "" : "= ") + pText(p) + ")");
    }
}

/// Blank glass should feel less like cloth than renderings do.
void flagBlankGlass(Flags& flags, const StudyData& data, const Cells& cells, const std::string& participant,
                    const QualityRules& rules)
{
    std::vector<double> blank, renderings;
    for (const Response& response : data.catchResponses)
        if (response.participant == participant && response.rating) blank.push_back(*response.rating);
    for (const QuestionInfo& question : data.questions)
        if (!question.isChoice)
            for (const double rating : valuesOf(allOf(data, cells, participant, question.id))) renderings.push_back(rating);
    if (blank.size() < rules.fewestCatchRatings || renderings.size() < rules.fewestAnswers) return;
    const stats::Value ofBlank = stats::meanOf(blank), ofRenderings = stats::meanOf(renderings);
    if (*ofBlank >= *ofRenderings)
        flags.add(
            participant, "blank_glass_rated_high",
            counted(blank.size(), "rating") + " of blank glass (catch trials) have at least the mean of the renderings' ratings");
}

}  // namespace

Json qualityFlags(const StudyData& data, const Cells& cells, const QualityRules& rules)
{
    Flags flags;
    for (const std::string& participant : data.participants) {
        flagMissing(flags, data, cells, participant);
        flagFast(flags, data, cells, participant, rules);
        flagStraightLining(flags, data, cells, participant, rules);
        flagSameAcross(flags, data, cells, participant, rules);
        flagSlotBias(flags, data, cells, participant, rules);
        flagBlankGlass(flags, data, cells, participant, rules);
    }
    if (data.voided > 0)
        flags.addForStudy("voided_presentations", counted(data.voided, "presentation") + (data.voided == 1 ? " was" : " were") +
                                                      " voided: kept in the data, not analysed, presented again");
    return flags.take();
}

Completeness completenessOf(const StudyData& data, const Cells& cells)
{
    Completeness completeness;
    for (const QuestionInfo& question : data.questions) completeness.present += cells.answered(question.id);
    completeness.expected = data.expectedResponses != 0
                                ? data.expectedResponses
                                : data.participants.size() * data.fabrics.size() * data.conditions.size() * data.questions.size();
    return completeness;
}

std::vector<std::string> ruleSentences(const QualityRules& rules)
{
    const auto percentOf = [](double share) { return fixed(100 * share, 0) + " %"; };
    return {
        "missing_answers: any participant with fewer answers than the design asks for.",
        "too_fast: more than " + percentOf(rules.tooFastShare) + " of the timed answers within " +
            shortest(rules.tooFastSeconds) + " s of the first touch.",
        "straight_lining: one value in at least " + percentOf(rules.sameRatingShare) + " of a question's ratings.",
        "same_across_questions: the same number to every rating question in at least " + percentOf(rules.sameAcrossShare) +
            " of the presentations.",
        "Both kinds of straight lining have a known weakness: somebody to whom all renderings feel alike answers so in earnest.",
        "blank_glass_rated_high: the mean rating of catch trials is not below the mean of the other ratings.",
        "slot_bias: the favourite tray slot is chosen more often than 1/m (exact binomial test, times the number of slots, p < " +
            shortest(rules.slotBiasP) + ").",
        "voided_presentations: presentations that were invalid; they are kept, not analysed, and were presented again.",
        "Shares are judged from " + std::to_string(rules.fewestAnswers) + " answers on. Flagged data stay in every analysis.",
    };
}

}  // namespace reports
