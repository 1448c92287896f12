#include "study/records/study_faults.h"

#include "database/evidence/acts.h"
#include "database/keys.h"
#include "protocols/files/sha256.h"
#include "rendering/display/stimulus_bank.h"
#include "study/records/folder_audit.h"
#include "study/records/registered_plan.h"

namespace study::records {

Findings findingsOf(const database::StudyStore& store)
{
    auto folder = findingsInFolder(store);
    Findings findings{store.faults(), std::move(folder.notes)};
    const auto add = [&](const std::vector<std::string>& more) {
        findings.faults.insert(findings.faults.end(), more.begin(), more.end());
    };
    add(faultsOfActs(store));
    add(folder.faults);
    if (!folder.isReadable) return findings;
    add(faultsOfKeys(store));
    add(rendering::faultsOfStimuli(store.folder().stimuli(), store.stimulusHashes()));
    const auto file = store.folder().protocol();
    if (!std::filesystem::exists(file))
        add({"protocol.json: missing"});
    else if (protocols::sha256OfFile(file) != store.protocolVersions().back().sha256)
        add({"protocol.json: changed since the study was made or last amended"});
    add(faultsOfRegisteredFiles(store));
    return findings;
}

}  // namespace study::records
