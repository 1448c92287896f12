#include "reports/analysis/screening.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

bool isReasonToExclude(FlagKind kind) { return std::ranges::find(reasonsToExclude(), kind) != reasonsToExclude().end(); }

using FlagsByParticipant = std::map<std::string, std::vector<FlagKind>>;

}  // namespace

std::span<const FlagKind> reasonsToExclude()
{
    static constexpr std::array kinds{FlagKind::TooFast, FlagKind::StraightLining, FlagKind::SameAcrossQuestions,
                                      FlagKind::SlotBias, FlagKind::BlankGlassRatedHigh};
    return kinds;
}

Screening screenParticipants(const StudyData& data, const AnswerCells& cells, const std::vector<QualityFlag>& flags)
{
    FlagsByParticipant flagged;
    for (const QualityFlag& flag : flags)
        if (flag.participant && isReasonToExclude(flag.kind)) flagged[*flag.participant].push_back(flag.kind);
    Screening screening;
    for (const auto& [participant, kinds] : flagged) screening.excluded.push_back({participant, kinds});
    screening.participantsBefore = answeringParticipants(data);
    std::set<std::string> left;
    for (const StudyResponse& response : data.responses)
        if (!flagged.contains(response.participant)) left.insert(response.participant);
    screening.participantsAfter = left.size();
    if (flagged.empty() || screening.participantsAfter == 0) {
        screening.why = flagged.empty() ? "nobody is flagged" : "everybody is flagged: nobody would be left";
        return screening;
    }
    const StudyData rest = withoutFlagged(data, screening);
    const AnswerCells after(rest);
    for (const QuestionInfo& question : data.questions) {
        if (!hasNumbers(question)) continue;
        screening.questions.push_back({question.id, {}});
        for (const std::string& condition : data.conditions)
            screening.questions.back().conditions.push_back({stats::meanOf(cells.participantMeans(question.id, condition)),
                                                             stats::meanOf(after.participantMeans(question.id, condition))});
    }
    return screening;
}

StudyData withoutFlagged(StudyData data, const Screening& screening)
{
    std::set<std::string> excluded;
    for (const ExcludedParticipant& one : screening.excluded) excluded.insert(one.participant);
    const auto isExcluded = [&](const auto& of) { return excluded.contains(of.participant); };
    std::erase_if(data.participants, [&](const std::string& participant) { return excluded.contains(participant); });
    for (auto* responses : {&data.responses, &data.catchResponses, &data.mismatchedResponses, &data.repeatedResponses})
        std::erase_if(*responses, isExcluded);
    std::erase_if(data.groupOf, [&](const auto& entry) { return excluded.contains(entry.first); });
    data.expectedResponses = data.expectedOfEmptyPlaces = 0;  // unknown for a part of the study
    return data;
}

}  // namespace reports
