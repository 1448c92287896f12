#include "study/records/study_faults.h"

#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/display/stimulus_bank.h"
#include "study/records/folder_audit.h"
#include "study/records/registered_plan.h"
#include "study/records/stored_study.h"

namespace study::records {

namespace {

std::vector<std::string> faultsOfProtocol(const database::StudyStore& store)
{
    const auto file = store.folder().protocol();
    if (!std::filesystem::exists(file)) return {"protocol.json: missing"};
    try {
        // A larger file is another text, so its size is enough.
        const auto text = protocols::readRegularFile(file, protocols::largestJson);
        if (protocols::sha256(text) == store.protocolVersions().back().sha256) return {};
    } catch (const protocols::Error& fault) {
        return {fault.what()};
    }
    return {"protocol.json: changed since the study was made or last amended"};
}

}  // namespace

Findings findingsOf(const database::StudyStore& store, const database::Passphrase& passphrase)
{
    auto folder = findingsInFolder(store);
    Findings findings{store.faults(), std::move(folder.notes)};
    const auto add = [&](const std::vector<std::string>& more) {
        findings.faults.insert(findings.faults.end(), more.begin(), more.end());
    };
    add(faultsOfActs(store));
    if (auto sentence = afterUnblindingSentence(store); !sentence.empty()) findings.notes.push_back(std::move(sentence));
    add(folder.faults);
    if (!folder.isReadable) return findings;
    const auto keys = findingsOfKeys(store, passphrase);
    add(keys.faults);
    findings.notes.insert(findings.notes.end(), keys.notes.begin(), keys.notes.end());
    add(rendering::faultsOfStimuli(store.folder().stimuli(), store.stimulusHashes()));
    add(faultsOfProtocol(store));
    add(faultsOfRegisteredFiles(store));
    return findings;
}

}  // namespace study::records
