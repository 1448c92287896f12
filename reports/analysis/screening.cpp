#include "reports/analysis/screening.h"

#include <algorithm>
#include <map>
#include <set>

#include "reports/analysis/quality_flags.h"
#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

const std::set<std::string> reasonsToExclude{"too_fast", "straight_lining", "same_across_questions", "slot_bias",
                                             "blank_glass_rated_high"};

std::map<std::string, std::vector<std::string>> flagsByParticipant(const StudyData& data, const Cells& cells)
{
    std::map<std::string, std::vector<std::string>> flags;
    for (const Json& flag : qualityFlags(data, cells))
        if (flag["participant"].is_string() && reasonsToExclude.contains(flag["flag"].get<std::string>()))
            flags[flag["participant"].get<std::string>()].push_back(flag["flag"].get<std::string>());
    return flags;
}

StudyData without(StudyData data, const std::map<std::string, std::vector<std::string>>& flagged)
{
    std::erase_if(data.participants, [&](const std::string& participant) { return flagged.contains(participant); });
    std::erase_if(data.responses, [&](const Response& response) { return flagged.contains(response.participant); });
    return data;
}

Json meansOf(const Cells& before, const Cells& after, const StudyData& data, const std::string& question)
{
    Json part = Json::object();
    for (const std::string& condition : data.conditions) {
        Json row = Json::object();
        put(row, "before", stats::meanOf(before.participantMeans(question, condition)));
        put(row, "after", stats::meanOf(after.participantMeans(question, condition)));
        part[condition] = std::move(row);
    }
    return part;
}

}  // namespace

Json screeningPart(const StudyData& data, const Cells& cells)
{
    const auto flagged = flagsByParticipant(data, cells);
    Json part{{"excluded", Json::array()}};
    for (const auto& [participant, flags] : flagged) part["excluded"].push_back({{"participant", participant}, {"flags", flags}});
    const StudyData rest = without(data, flagged);
    part["participants"] = {{"before", data.participants.size()}, {"after", rest.participants.size()}};
    if (flagged.empty() || rest.participants.empty()) {
        putNull(part, "questions", flagged.empty() ? "nobody is flagged" : "everybody is flagged: nobody would be left");
        return part;
    }
    const Cells after(rest);
    for (const QuestionInfo& question : data.questions) part["questions"][question.id] = meansOf(cells, after, data, question.id);
    return part;
}

}  // namespace reports
