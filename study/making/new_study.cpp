#include "study/making/new_study.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "database/keys.h"
#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/orders/allocation.h"
#include "rendering/display/stimulus_bank.h"
#include "study/making/made_with.h"
#include "study/making/planned_work.h"
#include "study/making/prompt_files.h"
#include "study/making/session_plan.h"
#include "study/making/study_images.h"
#include "study/making/study_material.h"
#include "study/session/clock.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;

/// True for a study of this program in which no human took part.
bool mayBeReplaced(const fs::path& study)
{
    if (!fs::exists(database::StudyFolder{study}.database())) return false;
    const auto slots = database::StudyStore({study}, database::StudyStore::Access::Read).slots();
    return std::none_of(slots.begin(), slots.end(), [](const database::Slot& slot) {
        return slot.state != database::SlotState::Free && slot.kind == database::ParticipantKind::Human;
    });
}

void requireFreePlace(const NewStudy& request)
{
    if (!fs::exists(request.study)) return;
    if (!request.replaceSimulated)
        throw protocols::badInput(
            {"the folder exists", request.study.string(), "the name of a new folder",
             "choose another name, or open this study with `vis2hap " + protocols::shellWord(request.study.string()) + "`"});
    if (!mayBeReplaced(request.study))
        throw protocols::badInput({"the folder holds answers of people, or is not a study; nothing was deleted",
                                   request.study.string(), "a study with simulated participants only",
                                   "move the folder or choose another name"});
}

/// The facts that are known before the images are made.
database::StudyFacts factsOf(const NewStudy& request, const StudyMaterial& material,
                             const std::map<std::string, std::string>& prompts)
{
    database::StudyFacts facts;
    facts.name = material.protocol.name;
    facts.protocolJson = material.protocolJson;
    facts.protocolSha256 = protocols::sha256(material.protocolJson);
    facts.designSeed = request.seed;
    facts.datasetPath = fs::absolute(request.dataset).lexically_normal().string();
    facts.datasetSha256 = hashOfDataset(request, material.dataset);
    facts.datasetProcedural = material.dataset.procedural;
    facts.modelSha256 = material.model ? material.model->summary.sha256 : "";
    facts.stamps = material.stamps;
    facts.fabrics = material.fabrics;
    for (const auto& fabric : facts.fabrics) facts.fabricNames[fabric] = material.dataset.fabric(fabric).name;
    facts.createdAt = session::SystemClock().wallTime();
    facts.programVersion = request.programVersion;
    facts.madeWith = madeWith(request, facts.modelSha256, prompts, material);
    facts.hasPassphrase = request.passphrase.has_value();
    if (!facts.hasPassphrase) facts.stamps.emplace_back(database::noPassphraseStamp);
    return facts;
}

void noteImages(const StudyImages& images, MadeStudy& made)
{
    auto& facts = made.facts;
    facts.signalsJson = images.signalsJson;
    facts.stamps.insert(facts.stamps.end(), images.stamps.begin(), images.stamps.end());
    made.warnings = facts.stamps;
    made.warnings.insert(made.warnings.end(), images.warnings.begin(), images.warnings.end());
    made.imagesReused = images.reused;
}

void noteAllocation(const protocols::Allocation& allocation, const FamiliarisationImages& familiarisation,
                    database::StudyFacts& facts)
{
    facts.swatches = allocation.swatches;
    for (std::size_t item = 0; item < familiarisation.names.size(); ++item)
        facts.familiarisation.push_back(
            {familiarisation.names[item], sealed(allocation.familiarisation[item], stationKeyOf(allocation.key.secret))});
}

/// Returns the hash of each file.
std::map<protocols::FileCode, std::string> writeStimuli(const fs::path& folder, const protocols::Allocation& allocation,
                                                        const StudyImages& images, const FamiliarisationImages& familiarisation)
{
    std::map<protocols::FileCode, std::string> hashes;
    const auto station = stationKeyOf(allocation.key.secret);
    const cv::Mat blank = cv::Mat::zeros(rendering::displayHeightPx, rendering::displayWidthPx, CV_8UC1);
    for (const auto& [code, entry] : allocation.key.entries) {
        const bool isCatchTrial = entry.condition == protocols::catchTrialId();
        hashes[code] = rendering::writeStimulus(
            folder, code, isCatchTrial ? blank : images.byCondition.at(entry.condition).at(entry.fabric), station);
    }
    for (std::size_t item = 0; item < familiarisation.images.size(); ++item) {
        const auto& code = allocation.familiarisation[item];
        hashes[code] = rendering::writeStimulus(folder, code, familiarisation.images[item], station);
    }
    return hashes;
}

/// The whole folder or nothing. Adds the hashes of the keys to the facts.
void writeStudy(const NewStudy& request, const protocols::Allocation& allocation, const StudyImages& images,
                const FamiliarisationImages& familiarisation, const std::map<std::string, std::string>& prompts,
                database::StudyFacts& facts)
{
    const auto earlier = request.replaceSimulated ? protocols::Earlier::Replaced : protocols::Earlier::Refused;
    protocols::FolderDraft draft(request.study, earlier);
    const database::StudyFolder folder{draft.path()};
    protocols::makeFolders(folder.stimuli(), protocols::Sync::Later);
    const auto hashes = writeStimuli(folder.stimuli(), allocation, images, familiarisation);
    const auto keys = database::writeKeys(folder, allocation.key, request.passphrase);
    facts.keySha256 = keys.allocation;
    facts.stationKeySha256 = keys.station;
    writePrompts(folder, prompts);
    protocols::writeWholeFile(folder.protocol(), facts.protocolJson, protocols::Sync::Later);
    database::StudyStore::create(folder, facts, allocation.participants, hashes);
    draft.putInPlace();
}

std::optional<protocols::BalanceCertificate> balanceWithEvenSlots(protocols::Protocol protocol)
{
    bool fewSwaps = false;
    for (auto& phase : protocol.phases)
        fewSwaps |= std::exchange(phase.trayAim, protocols::TrayAim::EvenSlots) == protocols::TrayAim::FewSwaps;
    if (!fewSwaps) return std::nullopt;
    return balanceOfExamples(protocol);
}

}  // namespace

void requireInputs(const NewStudy& request)
{
    requireFreePlace(request);
    requireMaterial(request);
}

MadeStudy makeStudy(const NewStudy& request, const StudyProgress& progress)
{
    const auto begin = [&](const char* stage) {
        if (progress.stage) progress.stage(stage);
    };
    requireFreePlace(request);
    begin("reading the protocol, drawing samples");
    StudyMaterial material = materialFor(request);
    if (progress.planned) progress.planned(plannedWork(material));
    if (!request.programs.empty()) begin("images by programs of the lab");
    addProgramImages(request, material, progress.programs);
    begin("the hash of the data set");
    const auto prompts = readPrompts(material.protocol, request.protocol);
    MadeStudy made;
    made.facts = factsOf(request, material, prompts);
    begin("signals and friction images");
    const StudyImages images = imagesFor(request, material, made.facts, progress);
    noteImages(images, made);
    for (std::string& remark : remarksOn(material.protocol)) made.warnings.push_back(std::move(remark));
    begin("images for familiarisation");
    const FamiliarisationImages familiarisation = familiarisationFor(request, material);
    if (material.protocol.familiarisationFabrics > 0 && material.render.conditions.empty())
        made.warnings.emplace_back(
            "familiarisation_fabrics: all conditions are the laboratory's own, so that no image can be made of other fabrics");

    begin("running orders");
    const auto secret = request.keySeed ? protocols::SecretKey::ofSeed(*request.keySeed) : protocols::SecretKey::drawn();
    const auto designSeed = designSeedOf(secret, request.seed);
    const auto design = protocols::drawDesign(material.protocol, designSeed);
    made.balance = balanceOfExamples(material.protocol);
    made.balanceWithEvenSlots = balanceWithEvenSlots(material.protocol);
    auto told = jsonOf(made.balance);
    told["of"] = protocols::balanceOfOthers;
    made.facts.plannedBalance = told.dump();
    const auto allocation =
        allocate(material.protocol, design, material.fabrics, secret, static_cast<int>(familiarisation.names.size()));
    noteAllocation(allocation, familiarisation, made.facts);
    begin("sealing and writing");
    writeStudy(request, allocation, images, familiarisation, prompts, made.facts);
    return made;
}

}  // namespace study::making
