#include "study/making/rehearsal.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "database/station_key.h"
#include "database/study_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/sha256.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;
using database::StudyStore;
using protocols::BlindedTrial;

constexpr std::size_t presentationsOfAPhase = 3;
constexpr int presentationsToABreak = 2;

/// The folder vanishes with this value.
struct RehearsalFolder {
    protocols::TemporaryFolder temporary;
    fs::path study = temporary.path() / "rehearsal";
};

/// A few trials of each phase under each of its instructions, phases in their order.
std::vector<BlindedTrial> fewOf(const std::vector<BlindedTrial>& all)
{
    std::random_device device;
    protocols::Random random((std::uint64_t{device()} << 32) | device());
    std::map<std::pair<int, protocols::InstructionId>, std::vector<BlindedTrial>> lists;
    for (const BlindedTrial& trial : all) lists[{trial.phase, trial.instruction}].push_back(trial);
    std::vector<BlindedTrial> few;
    for (auto& [list, trials] : lists) {
        random.shuffle(trials);
        trials.resize(std::min(trials.size(), presentationsOfAPhase));
        for (BlindedTrial& trial : trials) {
            trial.number.value = static_cast<int>(few.size()) + 1;
            few.push_back(std::move(trial));
        }
    }
    return few;
}

database::StudyFacts factsOfRehearsal(const StudyStore& store, int slot)
{
    auto facts = store.facts();
    auto protocol = nlohmann::ordered_json::parse(store.protocolVersions().back().json);
    facts.name = "Rehearsal of " + facts.name;
    protocol["name"] = facts.name;
    protocol["participants"] = 1;
    protocol["break_after"] = presentationsToABreak;
    facts.protocolJson = protocol.dump(2) + "\n";
    facts.protocolSha256 = protocols::sha256(facts.protocolJson);
    if (!facts.swatches.empty()) facts.swatches = {facts.swatches.at(static_cast<std::size_t>(slot) - 1)};
    facts.hasPassphrase = false;  // the rehearsal has no allocation key
    return facts;
}

/// Copies the stimuli that the trials and the familiarisation show. Returns their hashes.
std::map<protocols::FileCode, std::string> copyStimuli(const StudyStore& store, const std::vector<BlindedTrial>& trials,
                                                       const fs::path& to)
{
    const auto key = database::readStationKey(store);
    const auto hashes = store.stimulusHashes();
    std::map<protocols::FileCode, std::string> copied;
    const auto copy = [&](const protocols::SealedCode& sealedCode) {
        const auto code = protocols::opened(sealedCode, key);
        if (!copied.emplace(code, hashes.at(code)).second) return;
        const std::string file = code.value + ".sealed";
        protocols::writeWholeFile(to / file, protocols::readWholeFile(store.folder().stimuli() / file), protocols::Sync::Later);
    };
    for (const BlindedTrial& trial : trials) copy(trial.sealedCode);
    for (const auto& item : store.facts().familiarisation) copy(item.sealedCode);
    return copied;
}

}  // namespace

std::shared_ptr<const fs::path> makeRehearsal(const fs::path& study)
{
    const StudyStore store({study}, StudyStore::Access::Read);
    const int slot = store.slots().back().number;
    const auto trials = fewOf(store.trials(slot));
    const auto facts = factsOfRehearsal(store, slot);
    const auto made = std::make_shared<RehearsalFolder>();
    const database::StudyFolder folder{made->study};
    protocols::makeFolders(folder.stimuli(), protocols::Sync::Later);
    const auto hashes = copyStimuli(store, trials, folder.stimuli());
    protocols::writeWholeFile(folder.stationKey(), protocols::readWholeFile(store.folder().stationKey()), protocols::Sync::Later);
    protocols::writeWholeFile(folder.protocol(), facts.protocolJson, protocols::Sync::Later);
    StudyStore::create(folder, facts, {trials}, hashes);
    return {made, &made->study};
}

}  // namespace study::making
