#include "study/making/study_plan.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "reports/analysis/screening.h"
#include "reports/data/registration.h"

namespace study::making {

std::string timingOf(const RegistrationStamp& stamp) { return reports::timingText(stamp.answersBefore, stamp.afterUnblinding); }

StudyPlan planOf(const database::StudyStore& store, const std::string& program)
{
    StudyPlan plan;
    plan.facts = store.facts();
    plan.version = store.protocolVersions().back();
    const auto file = store.folder().protocol();
    if (protocols::sha256(protocols::readWholeFile(file)) != plan.version.sha256)
        throw protocols::badInput({"the protocol was edited, and the study has not taken the edit", file.string(),
                                   "the protocol that the study stores",
                                   "run `vis2hap study amend`, with --who and --why to take the edit or with --undo"});
    plan.protocol = protocols::keptProtocolFromJson(plan.version.json, "the study's protocol", plan.facts.programVersion);
    plan.contrasts = contrastsInOrder(plan.protocol);
    plan.power = analyse::questionPowers(plan.protocol);
    plan.program = program;
    return plan;
}

ExclusionRules exclusionRules(const protocols::Protocol& protocol)
{
    ExclusionRules rules{reports::ruleSentences(), {}};
    const auto hasMismatches = [](const protocols::Phase& phase) { return phase.anchors.mismatched > 0; };
    if (std::ranges::any_of(protocol.phases, hasMismatches)) rules.sentences.push_back(reports::mismatchRule());
    for (const reports::FlagKind kind : reports::reasonsToExclude()) rules.flags.push_back(nameOf(kind));
    return rules;
}

}  // namespace study::making
