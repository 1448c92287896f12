#include "study/making/study_material.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/random.h"
#include "protocols/usual_texts.h"
#include "rendering/fabrics/dataset_hash.h"
#include "rendering/response/response_file.h"
#include "study/making/sample_choice.h"

namespace study::making {

namespace {

using rendering::fabrics::Dataset;

/// Keeps the file byte for byte, without a mark of the byte order, unless the request changes the number of participants.
void readProtocol(const NewStudy& request, StudyMaterial& material)
{
    const std::string where = request.protocol.empty() ? "the paper's protocol" : request.protocol.string();
    auto& json = material.protocolJson;
    json = request.protocol.empty() ? protocols::paperProtocolIn(request.language)
                                    : std::string(protocols::withoutByteOrderMark(protocols::readProtocolText(request.protocol)));
    material.protocol = protocols::protocolFromJson(json, where);
    if (!request.participants || *request.participants == material.protocol.participants) return;
    auto changed = nlohmann::ordered_json::parse(json);
    changed["participants"] = *request.participants;
    json = changed.dump(2) + "\n";
    material.protocol =
        protocols::protocolFromJson(json, where + " with --participants " + std::to_string(*request.participants));
}

/// The fabrics that the protocol names, or as many as it asks for, drawn by seed.
std::vector<protocols::FabricId> chosenFabrics(const protocols::Protocol& protocol, const Dataset& dataset, std::uint64_t seed)
{
    if (!protocol.fabrics.empty()) {
        for (const auto& fabric : protocol.fabrics) (void)dataset.fabric(fabric);  // throws for an unknown one
        return protocol.fabrics;
    }
    if (static_cast<int>(dataset.fabrics.size()) < protocol.fabricCount)
        throw protocols::badInput({"the data set has " + std::to_string(dataset.fabrics.size()) + " fabrics",
                                   dataset.folder.string(),
                                   "at least " + std::to_string(protocol.fabricCount) + " fabrics, as the protocol states",
                                   "use a larger data set or a protocol with fewer fabrics"});
    std::vector<protocols::FabricId> fabrics;
    for (const auto& fabric : dataset.fabrics) fabrics.push_back(fabric.id);
    protocols::Random::stream(seed, "fabrics of the study").shuffle(fabrics);
    fabrics.resize(protocol.fabricCount);
    std::sort(fabrics.begin(), fabrics.end());
    return fabrics;
}

/// Throws badInput for an id that the tables of a new study cannot hold. Data sets of earlier versions may have one.
std::vector<protocols::FabricId> fabricsFor(const protocols::Protocol& protocol, const Dataset& dataset, std::uint64_t seed)
{
    std::vector<protocols::FabricId> fabrics = chosenFabrics(protocol, dataset, seed);
    for (const auto& fabric : fabrics) protocols::requireGoodNewId(fabric.value, "a fabric", dataset.folder.string());
    return fabrics;
}

std::string conditionsShow(std::size_t conditions)
{
    return conditions == 1 ? "1 condition shows" : std::to_string(conditions) + " conditions show";
}

void readModel(const NewStudy& request, StudyMaterial& material)
{
    namespace models = rendering::models;
    material.model = models::readModelCardFields(request.model.empty() ? models::shippedModel() : request.model);
    material.control = request.control;
    if (!request.control.empty())
        (void)models::readModelCardFields(request.control);  // refuses weights without a card before any work
}

void readDisplayResponse(const NewStudy& request, StudyMaterial& material)
{
    if (request.response.empty()) return;
    material.responseJson = protocols::readRegularFile(request.response, rendering::largestResponseFile);
    material.render.mapping.response = std::make_shared<rendering::DisplayResponse>(
        rendering::responseFromJson(material.responseJson, request.response.string()));
    if (!material.own.images.empty() || !request.programs.empty())
        material.stamps.emplace_back(
            "Images of the laboratory's own conditions are shown as they are, without the response of the display.");
}

}  // namespace

void requireMaterial(const NewStudy& request)
{
    StudyMaterial material;
    readProtocol(request, material);
    (void)fabricsFor(material.protocol, rendering::fabrics::readDataset(request.dataset), request.seed);
}

StudyMaterial materialFor(const NewStudy& request)
{
    StudyMaterial material;
    readProtocol(request, material);
    requirePrograms(material.protocol, request.programs,
                    request.protocol.empty() ? "the paper's protocol" : request.protocol.string());
    material.dataset = rendering::fabrics::readDataset(request.dataset);
    material.fabrics = fabricsFor(material.protocol, material.dataset, request.seed);
    for (const auto& id : material.protocol.conditions)
        if (!isOwnCondition(material.protocol, id)) material.render.conditions.push_back(id);
    material.own = readOwnImages(material.protocol, request.protocol.parent_path(), material.fabrics);
    auto signals = rendering::signalsFor(std::span<const protocols::ConditionId>(material.render.conditions));
    if (!request.programs.empty()) signals.push_back(rendering::Signal::Photograph);
    if (needsGenerators(signals)) readModel(request, material);
    const auto chosen =
        chooseSamples(material.dataset, material.fabrics, signals, material.model ? &material.model->summary : nullptr,
                      request.seed, request.allowTrainingSamples);
    if (material.model && request.model.empty() && !material.dataset.procedural && !chosen.someTrainedOn)
        material.stamps.push_back(
            "The shipped weights generated the signals. They were trained on drawn fabrics and on scanned cloth, not on this "
            "data set.");
    if (chosen.someTrainedOn)
        material.stamps.push_back(
            "Some samples shown in this study were among the training samples of the generators (--allow-training-samples).");
    material.render.fabrics = material.fabrics;
    material.render.rangeOver = material.fabrics;
    material.render.samples = chosen.samples;
    material.render.generation.model = request.model;
    material.render.cache = request.cache;
    if (!material.own.images.empty())
        material.stamps.push_back(conditionsShow(material.own.images.size()) +
                                  " ready images that this program did not make. How they were made is not known to it.");
    readDisplayResponse(request, material);
    return material;
}

void addProgramImages(const NewStudy& request, StudyMaterial& material,
                      const std::function<void(const std::string& stage, int done, int total)>& progress)
{
    if (request.programs.empty()) return;
    ProgramImages made = imagesOfPrograms(request.programs, material.dataset, material.fabrics, material.render.samples,
                                          request.programLimits, progress);
    material.own.images.merge(made.own.images);
    material.own.sha256.merge(made.own.sha256);
    material.own.warnings.insert(material.own.warnings.end(), made.own.warnings.begin(), made.own.warnings.end());
    material.stamps.push_back(conditionsShow(made.used.size()) +
                              " images of a program of the laboratory. How they were made is not known to this program.");
    material.programs = std::move(made.used);
}

std::string hashOfDataset(const NewStudy& request, const Dataset& dataset)
{
    if (!request.cache) return hashOf(dataset);
    return hashOf(dataset, [&](const std::filesystem::path& file) { return request.cache->hashOfFile(file); });
}

}  // namespace study::making
