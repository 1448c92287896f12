#include "reports/analysis/screening.h"

#include <algorithm>
#include <map>

#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

bool isReasonToExclude(FlagKind kind)
{
    switch (kind) {
        case FlagKind::TooFast:
        case FlagKind::StraightLining:
        case FlagKind::SameAcrossQuestions:
        case FlagKind::SlotBias:
        case FlagKind::BlankGlassRatedHigh:
            return true;
        case FlagKind::MissingAnswers:
        case FlagKind::VoidedPresentations:
            return false;
    }
    return false;
}

using FlagsByParticipant = std::map<std::string, std::vector<FlagKind>>;

StudyData without(StudyData data, const FlagsByParticipant& flagged)
{
    std::erase_if(data.participants, [&](const std::string& participant) { return flagged.contains(participant); });
    std::erase_if(data.responses, [&](const StudyResponse& response) { return flagged.contains(response.participant); });
    return data;
}

}  // namespace

Screening screenParticipants(const StudyData& data, const AnswerCells& cells, const std::vector<QualityFlag>& flags)
{
    FlagsByParticipant flagged;
    for (const QualityFlag& flag : flags)
        if (flag.participant && isReasonToExclude(flag.kind)) flagged[*flag.participant].push_back(flag.kind);
    Screening screening;
    for (const auto& [participant, kinds] : flagged) screening.excluded.push_back({participant, kinds});
    screening.participantsBefore = data.participants.size();
    const StudyData rest = without(data, flagged);
    screening.participantsAfter = rest.participants.size();
    if (flagged.empty() || rest.participants.empty()) {
        screening.why = flagged.empty() ? "nobody is flagged" : "everybody is flagged: nobody would be left";
        return screening;
    }
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

}  // namespace reports
