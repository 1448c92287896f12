#include "study/making/new_study.h"

#include <unistd.h>

#include <algorithm>

#include "database/keys.h"
#include "protocols/allocation.h"
#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/protocol_json.h"
#include "protocols/random.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/composition/photograph_warnings.h"
#include "rendering/composition/render_json.h"
#include "rendering/display/stimulus_bank.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/making/image_folder.h"
#include "study/making/sample_choice.h"
#include "study/making/signal_quality.h"
#include "study/session/clock.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
using rendering::fabrics::Dataset;

struct ProtocolText {
    std::string json;
    protocols::Protocol protocol;
};

/// The text that is kept and hashed: the file byte for byte, unless the number of participants is changed.
ProtocolText protocolText(const NewStudy& request)
{
    const std::string where = request.protocol.empty() ? "the paper's protocol" : request.protocol.string();
    ProtocolText text;
    text.json = request.protocol.empty() ? std::string(protocols::paperProtocolJson()) : readFile(request.protocol);
    text.protocol = protocols::protocolFromJson(text.json, where);
    if (request.participants && *request.participants != text.protocol.participants) {
        auto json = nlohmann::ordered_json::parse(text.json);
        json["participants"] = *request.participants;
        text.json = json.dump(2) + "\n";
        text.protocol =
            protocols::protocolFromJson(text.json, where + " with --participants " + std::to_string(*request.participants));
    }
    return text;
}

std::vector<protocols::FabricId> drawFabrics(const Dataset& dataset, const protocols::Protocol& protocol, std::uint64_t seed)
{
    if (!protocol.fabrics.empty()) {
        for (const auto& fabric : protocol.fabrics) (void)dataset.fabric(fabric);
        return protocol.fabrics;
    }
    if (static_cast<int>(dataset.fabrics.size()) < protocol.fabricCount)
        throw protocols::badInput({"the data set has " + std::to_string(dataset.fabrics.size()) + " fabrics",
                                   dataset.folder.string(),
                                   std::to_string(protocol.fabricCount) + " or more, as the protocol says",
                                   "use a larger data set or a protocol with fewer fabrics"});
    std::vector<protocols::FabricId> fabrics;
    for (const auto& fabric : dataset.fabrics) fabrics.push_back(fabric.id);
    protocols::Random::stream(seed, "fabrics of the study").shuffle(fabrics);
    fabrics.resize(protocol.fabricCount);
    std::sort(fabrics.begin(), fabrics.end());
    return fabrics;
}

/// Whether a study lies there that may be remade: one of ours in which no human took part.
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
        throw protocols::badInput({"the folder exists", request.study.string(), "a new folder for a new study",
                                   "choose another name, or open this one with `vis2hap " + request.study.string() + "`"});
    if (!mayBeReplaced(request.study))
        throw protocols::badInput({"it holds answers of people, or is no study", request.study.string(),
                                   "a study of simulated participants alone",
                                   "move it away or choose another name; nothing was deleted"});
}

/// A folder that vanishes unless it becomes the study.
class Unfinished {
public:
    explicit Unfinished(const fs::path& study) : m_study(study), m_folder(study)
    {
        m_folder += ".making-" + std::to_string(getpid());
        std::error_code failure;
        fs::create_directories(m_folder / "stimuli", failure);
        if (failure)
            throw protocols::environmentFault({"cannot make the folder (" + failure.message() + ")", m_folder.string(),
                                               "a writable place", "choose another one"});
    }
    ~Unfinished()
    {
        std::error_code ignored;
        fs::remove_all(m_folder, ignored);
    }
    database::StudyFolder folder() const { return {m_folder}; }
    void becomeStudy()
    {
        fs::path old = m_study;
        old += ".old-" + std::to_string(getpid());
        std::error_code failure;
        if (fs::exists(m_study)) fs::rename(m_study, old, failure);
        if (!failure) fs::rename(m_folder, m_study, failure);
        if (failure)
            throw protocols::environmentFault({"cannot be put in place (" + failure.message() + ")", m_study.string(),
                                               "a writable place", "choose another one"});
        fs::remove_all(old, failure);
    }

private:
    fs::path m_study, m_folder;
};

struct Images {
    std::map<protocols::ConditionId, std::map<protocols::FabricId, cv::Mat>> byCondition;
    std::string signalsJson = "{}";
    bool reused = false;
    std::vector<std::string> stamps;    ///< photographs that the generators do not know
    std::vector<std::string> warnings;  ///< of photographs; none where images are reused
};

/// As reports print it.
std::string sentence(std::string line)
{
    line[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
    return line + ".";
}

Images friction(const NewStudy& request, const Dataset& dataset, const rendering::RenderRequest& render, const std::string& key,
                const StepProgress& progress)
{
    Images images;
    if (!request.images.empty())
        if (auto kept = readImageFolder(request.images, key, render)) {
            images.byCondition = std::move(kept->images);
            images.signalsJson = kept->signalsJson;
            images.stamps = kept->stamps;
            images.reused = true;
            return images;
        }
    auto rendering = renderFabrics(dataset, render, progress);
    images.signalsJson = signalQuality(rendering.signals).dump();
    for (const auto& line : unfamiliarPhotographs(rendering)) images.stamps.push_back(sentence(line));
    images.warnings = shadingWarnings(rendering);
    for (const auto& line : cutPhotographs(rendering)) images.warnings.push_back(line);
    if (!request.images.empty())
        writeImageFolder(request.images, key, renderJson(dataset, render, rendering), rendering, images.signalsJson,
                         images.stamps);
    for (auto& condition : rendering.conditions) images.byCondition[condition.condition] = std::move(condition.images);
    return images;
}

std::map<protocols::FileCode, std::string> writeStimuli(const fs::path& folder, const protocols::AllocationKey& key,
                                                        const Images& images)
{
    std::map<protocols::FileCode, std::string> hashes;
    const cv::Mat blank = cv::Mat::zeros(rendering::displayHeightPx, rendering::displayWidthPx, CV_8UC1);
    for (const auto& [code, entry] : key.entries) {
        const bool isCatchTrial = entry.condition == protocols::catchTrialId();
        hashes[code] = rendering::writeStimulus(folder, code,
                                                isCatchTrial ? blank : images.byCondition.at(entry.condition).at(entry.fabric));
    }
    return hashes;
}

/// Fabrics outside the study's for getting to know the display, each with one friction image.
struct Familiarisation {
    std::vector<std::string> names;
    std::vector<cv::Mat> images;
};

bool hasSamplesFor(const Dataset& dataset, const protocols::FabricId& fabric, const std::vector<rendering::Signal>& signals)
{
    const auto lacks = [&](rendering::Signal signal, rendering::fabrics::Modality modality) {
        return std::find(signals.begin(), signals.end(), signal) != signals.end() &&
               sampleIndices(dataset, fabric, modality).empty();
    };
    return !lacks(rendering::Signal::Photograph, rendering::fabrics::Modality::Visual) &&
           !lacks(rendering::Signal::TactileFrame, rendering::fabrics::Modality::Tactile) &&
           !lacks(rendering::Signal::FrictionRecord, rendering::fabrics::Modality::Friction);
}

/// The richest condition, by the protocol's order, is enough to get to know the display by; nothing else is rendered.
Familiarisation familiarisationFor(const NewStudy& request, const Dataset& dataset, const protocols::Protocol& protocol,
                                   const std::vector<protocols::FabricId>& studied)
{
    rendering::RenderRequest render;
    render.conditions = {protocol.conditions.back()};
    render.generation.model = request.model;
    const auto signals = rendering::signalsFor(std::span<const protocols::ConditionId>(render.conditions));
    for (const auto& fabric : dataset.fabrics)
        if (std::find(studied.begin(), studied.end(), fabric.id) == studied.end() && hasSamplesFor(dataset, fabric.id, signals))
            render.fabrics.push_back(fabric.id);
    protocols::Random::stream(request.seed, "fabrics for familiarisation").shuffle(render.fabrics);
    if (static_cast<int>(render.fabrics.size()) > protocol.familiarisationFabrics)
        render.fabrics.resize(static_cast<std::size_t>(protocol.familiarisationFabrics));
    Familiarisation familiarisation;
    if (render.fabrics.empty()) return familiarisation;
    render.rangeOver = render.fabrics;
    render.samples = chooseSamples(dataset, render.fabrics, signals, nullptr, request.seed, true).samples;
    const auto rendering = renderFabrics(dataset, render);
    for (const auto& fabric : render.fabrics) {
        familiarisation.names.push_back(dataset.fabric(fabric).name);
        familiarisation.images.push_back(rendering.conditions.front().images.at(fabric));
    }
    return familiarisation;
}

struct Model {
    std::optional<rendering::models::ModelCard> card;
    std::vector<std::string> stamps;
};

Model modelFor(const NewStudy& request, const Dataset& dataset, const std::vector<rendering::Signal>& signals)
{
    Model model;
    if (!needsGenerators(signals)) return model;
    model.card = rendering::models::readModelCard(request.model.empty() ? rendering::models::shippedModel() : request.model);
    if (request.model.empty() && !dataset.procedural)
        model.stamps.push_back(
            "Generated signals come from the shipped weights, which were trained on procedural fabrics, not on this data set.");
    return model;
}

}  // namespace

MadeStudy makeStudy(const NewStudy& request, const StepProgress& progress)
{
    requireFreePlace(request);
    const auto text = protocolText(request);
    const auto dataset = rendering::fabrics::readDataset(request.dataset);
    const auto fabrics = drawFabrics(dataset, text.protocol, request.seed);
    const auto signals = rendering::signalsFor(std::span<const protocols::ConditionId>(text.protocol.conditions));
    const auto model = modelFor(request, dataset, signals);
    const auto* card = model.card ? &*model.card : nullptr;
    const auto samples = chooseSamples(dataset, fabrics, signals, card, request.seed, request.allowTrainingSamples);

    rendering::RenderRequest render;
    render.fabrics = fabrics;
    render.rangeOver = fabrics;
    render.conditions = text.protocol.conditions;
    render.samples = samples.samples;
    render.generation.model = request.model;

    MadeStudy made;
    auto& facts = made.facts;
    facts.name = text.protocol.name;
    facts.protocolJson = text.json;
    facts.protocolSha256 = protocols::sha256(text.json);
    facts.designSeed = request.seed;
    facts.datasetPath = fs::absolute(request.dataset).lexically_normal().string();
    facts.datasetSha256 = hashOf(dataset);
    facts.datasetProcedural = dataset.procedural;
    facts.modelSha256 = card ? card->sha256 : "";
    facts.stamps = model.stamps;
    if (samples.someTrainedOn)
        facts.stamps.push_back(
            "Some fabrics are shown by samples that the generators were trained on (--allow-training-samples).");
    facts.fabrics = fabrics;
    for (const auto& fabric : fabrics) facts.fabricNames[fabric] = dataset.fabric(fabric).name;
    facts.createdAt = session::SystemClock().wallTime();
    facts.programVersion = versionText();

    const auto images = friction(request, dataset, render, imageFolderKey(facts, render), progress);
    facts.signalsJson = images.signalsJson;
    facts.stamps.insert(facts.stamps.end(), images.stamps.begin(), images.stamps.end());
    made.warnings = facts.stamps;
    made.imagesReused = images.reused;
    made.warnings.insert(made.warnings.end(), images.warnings.begin(), images.warnings.end());

    const auto design = protocols::drawDesign(text.protocol, request.seed);
    made.balance = balanceOf(design, text.protocol);
    const auto secret = request.keySeed ? *request.keySeed : protocols::drawSecretSeed();
    const auto familiarisation = familiarisationFor(request, dataset, text.protocol, fabrics);
    const auto allocation = allocate(text.protocol, design, fabrics, secret, static_cast<int>(familiarisation.names.size()));
    facts.swatches = allocation.swatches;
    for (std::size_t item = 0; item < familiarisation.names.size(); ++item)
        facts.familiarisation.push_back({familiarisation.names[item], allocation.familiarisation[item]});

    Unfinished unfinished(request.study);
    const auto folder = unfinished.folder();
    auto hashes = writeStimuli(folder.stimuli(), allocation.key, images);
    for (std::size_t item = 0; item < familiarisation.images.size(); ++item) {
        const auto& code = allocation.familiarisation[item];
        hashes[code] = rendering::writeStimulus(folder.stimuli(), code, familiarisation.images[item]);
    }
    const auto keys = database::writeKeys(folder, allocation.key);
    facts.keySha256 = keys.allocation;
    facts.maskedKeySha256 = keys.masked;
    writeFile(folder.protocol(), text.json);
    database::StudyStore::create(folder, facts, allocation.participants, hashes);
    unfinished.becomeStudy();
    return made;
}

}  // namespace study::commands
