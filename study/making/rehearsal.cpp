#include "study/making/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "database/disk/server_note.h"
#include "database/disk/station_key.h"
#include "database/study_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/random.h"
#include "rendering/composition/friction_image.h"
#include "rendering/display/stimulus_bank.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;
using database::StudyStore;
using protocols::BlindedTrial;
using protocols::FileCode;

constexpr std::size_t presentationsOfAPhase = 3;
constexpr int presentationsToABreak = 2;
constexpr double shortestPeriodPx = 8, longestPeriodPx = 96;  ///< of the drawn images; threads of a cloth are as far apart

/// The folder vanishes with this value.
struct RehearsalFolder {
    protocols::TemporaryFolder temporary;
    fs::path study = temporary.path() / "rehearsal";
};

/// A few trials of each phase under each of its instructions, phases in their order.
std::vector<BlindedTrial> fewOf(const std::vector<BlindedTrial>& all, protocols::Random& random)
{
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

database::StudyFacts factsOfRehearsal(const StudyStore& store)
{
    auto facts = store.facts();
    auto protocol = protocols::parseStrictOrderedJson(store.protocolVersions().back().json, "the study's protocol");
    facts.name = "Rehearsal of " + facts.name;
    protocol["name"] = facts.name;
    protocol["participants"] = 1;
    protocol["break_after"] = presentationsToABreak;
    facts.protocolJson = protocol.dump(2) + "\n";
    facts.protocolSha256 = protocols::sha256(facts.protocolJson);
    if (!facts.swatches.empty()) facts.swatches = {facts.swatches.back()};
    facts.hasPassphrase = false;  // the rehearsal has no allocation key
    facts.keySha256.clear();
    facts.plannedBalance = "{}";
    return facts;
}

/// The running order of one participant, drawn by a secret of the rehearsal alone.
protocols::Allocation allocationOf(const database::StudyFacts& facts, const protocols::SecretKey& secret)
{
    const auto protocol =
        protocols::keptProtocolFromJson(facts.protocolJson, "the protocol of the rehearsal", facts.programVersion);
    return allocate(protocol, protocols::drawDesign(protocol, designSeedOf(secret, 0)), facts.fabrics, secret,
                    static_cast<int>(facts.familiarisation.size()));
}

/// One row of a wave from 0 to 127 with a drawn period and phase.
std::vector<int> drawnWave(int length, protocols::Random& random)
{
    const double period = random.uniform(shortestPeriodPx, longestPeriodPx), phase = random.uniform();
    std::vector<int> wave;
    for (int at = 0; at < length; ++at)
        wave.push_back(static_cast<int>(std::lround(63.5 * (1 + std::sin(2 * std::numbers::pi * (at / period + phase))))));
    return wave;
}

/// Waves along and across the stroke, like threads of a cloth. It follows from `random` alone.
cv::Mat drawnImage(protocols::Random& random)
{
    const auto along = drawnWave(rendering::displayWidthPx, random), across = drawnWave(rendering::displayHeightPx, random);
    cv::Mat image(rendering::displayHeightPx, rendering::displayWidthPx, CV_8UC1);
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x)
            image.at<unsigned char>(y, x) =
                static_cast<unsigned char>(along[static_cast<std::size_t>(x)] + across[static_cast<std::size_t>(y)]);
    return image;
}

/// Draws an image for every code. Returns the hashes of the files.
std::map<FileCode, std::string> writeDrawnImages(const fs::path& stimuli, const std::set<FileCode>& codes,
                                                 const protocols::SecretKey& stationKey, protocols::Random& random)
{
    std::map<FileCode, std::string> hashes;
    for (const FileCode& code : codes) hashes[code] = rendering::writeStimulus(stimuli, code, drawnImage(random), stationKey);
    return hashes;
}

/// Throws where a session of the study could not show its images. All are read, so that no access tells one from another.
void requireImages(const StudyStore& store)
{
    (void)rendering::StimulusBank(store.folder().stimuli(), store.stimulusHashes(),
                                  database::readStationKey(store.folder(), store.facts().stationKeySha256));
}

}  // namespace

std::shared_ptr<const fs::path> makeRehearsal(const fs::path& study)
{
    if (database::readServerNote(study))
        throw protocols::badInput({"a rehearsal needs the images of the study, which lie on the server", study.string(),
                                   "the folder of a study on no server", "rehearse before the study moves there"});
    const StudyStore store({study}, StudyStore::Access::Read);
    requireImages(store);
    const auto secret = protocols::SecretKey::drawn();
    const auto stationKey = stationKeyOf(secret);
    protocols::Random random(secret.seedFor("rehearsal"));
    auto facts = factsOfRehearsal(store);
    const auto allocation = allocationOf(facts, secret);
    const auto trials = fewOf(allocation.participants.front(), random);
    std::set<FileCode> shown(allocation.familiarisation.begin(), allocation.familiarisation.end());
    for (const BlindedTrial& trial : trials) shown.insert(opened(trial.sealedCode, stationKey));
    for (std::size_t item = 0; item < facts.familiarisation.size(); ++item)
        facts.familiarisation[item].sealedCode = sealed(allocation.familiarisation[item], stationKey);

    const auto made = std::make_shared<RehearsalFolder>();
    const database::StudyFolder folder{made->study};
    protocols::makeFolders(folder.stimuli(), protocols::Sync::Later);
    const auto hashes = writeDrawnImages(folder.stimuli(), shown, stationKey, random);
    facts.stationKeySha256 = database::writeStationKey(folder, stationKey);
    protocols::writeWholeFile(folder.protocol(), facts.protocolJson, protocols::Sync::Later);
    StudyStore::create(folder, facts, {trials}, hashes);
    return {made, &made->study};
}

}  // namespace study::making
