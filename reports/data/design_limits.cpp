#include "reports/data/design_limits.h"

#include <set>

#include "reports/text/plain_words.h"

namespace reports {

std::size_t pairCount(const StudyData& data) { return data.conditions.size() * (data.conditions.size() - 1) / 2; }

bool comparesAllPairs(const StudyData& data) { return data.everyPair || pairCount(data) <= mostUsualPairs; }

bool canSpeakForOtherFabrics(const StudyData& data)
{
    return answeringParticipants(data) >= fewestParticipants && data.fabrics.size() >= fewestFabrics;
}

std::vector<std::string> designLimits(const StudyData& data, Depth depth)
{
    std::vector<std::string> limits;
    if (data.answersPerCell > 1)
        limits.push_back(
            "A participant answered up to " + std::to_string(data.answersPerCell) +
            " times to one fabric under one condition. Every test between conditions takes the mean of these answers "
            "as one value. Where some are missing, comparisons take the repetitions and instructions that the participant "
            "answered under each of the conditions compared. Counts, exact tests of trials and the logistic and ordinal models "
            "take each answer. Their standard errors are too small, because these models have no random effect of the single "
            "cell.");
    std::set<std::string> groups;
    for (const auto& [participant, group] : data.groupOf) groups.insert(group);
    if (groups.size() > 1)
        limits.push_back("The participants belong to " + counted(groups.size(), "group") +
                         ". The claims average over the groups: they hold for people who are mixed as these were. The tables of "
                         "groups compare them for these fabrics only; no model has the group as a term.");
    if (!comparesAllPairs(data))
        limits.push_back("There are " + counted(pairCount(data), "pair") +
                         " of conditions. They are compared only if `report --pairs` asks for it; planned contrasts always are.");
    else if (pairCount(data) > mostUsualPairs)
        limits.push_back("There are " + counted(pairCount(data), "pair") +
                         " of conditions. Their tables are too long for this page and stand in the folder tables only.");
    if (depth == Depth::Quick)
        limits.push_back(
            "This is a quick report. It has no analyses with one fabric, one participant or the flagged participants "
            "left out, no ordinal models, and no sheet of friction images. No claim rests on them.");
    return limits;
}

}  // namespace reports
