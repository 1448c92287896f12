#include "study/records/study_faults.h"

#include "database/keys.h"
#include "protocols/files/sha256.h"
#include "rendering/display/stimulus_bank.h"
#include "study/records/registered_plan.h"

namespace study::records {

std::vector<std::string> faultsOf(const database::StudyStore& store)
{
    auto faults = store.faults();
    const auto add = [&](const std::vector<std::string>& more) { faults.insert(faults.end(), more.begin(), more.end()); };
    add(faultsOfKeys(store));
    add(rendering::faultsOfStimuli(store.folder().stimuli(), store.stimulusHashes()));
    const auto file = store.folder().protocol();
    if (!std::filesystem::exists(file))
        faults.push_back("protocol.json: missing");
    else if (protocols::sha256OfFile(file) != store.protocolVersions().back().sha256)
        faults.push_back("protocol.json: changed since the study was made or last amended");
    add(faultsOfRegisteredFiles(store));
    return faults;
}

}  // namespace study::records
