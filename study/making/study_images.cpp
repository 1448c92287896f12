#include "study/making/study_images.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/random.h"
#include "rendering/cache/cache_key.h"
#include "rendering/composition/image_warnings.h"
#include "rendering/composition/photograph_warnings.h"
#include "rendering/composition/render_json.h"
#include "rendering/models/kept_generation.h"
#include "reports/json/prices_json.h"
#include "reports/json/signals_json.h"
#include "study/making/image_folder.h"
#include "study/making/rendering_prices.h"
#include "study/making/sample_choice.h"
#include "study/making/signal_controls.h"
#include "study/making/signal_quality.h"
#include "study/records/stored_study.h"

namespace study::making {

namespace {

using records::imageWarningsField;
using records::pricesField;

using rendering::Signal;
using rendering::fabrics::Dataset;
using rendering::fabrics::Modality;

/// The line as a sentence of the report, with a capital letter and a full stop.
std::string sentence(std::string line)
{
    line[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
    return line + ".";
}

/// Everything that the comparison follows from: the files of the data set, the samples, the weights and the programs.
std::string keyOfComparison(const NewStudy& request, const StudyMaterial& material, const std::string& imagesKey,
                            const database::StudyFacts& facts)
{
    rendering::cache::CacheKey key(*request.cache, "comparison of signals");
    key.add("images", imagesKey).add("dataset", facts.datasetSha256).add("seed", request.seed);
    if (material.model)
        key.add("generators", rendering::models::identityOfGenerators(*request.cache, material.render.generation));
    if (!material.control.empty())
        key.addFile("control", material.control).addFile("card", rendering::models::cardOf(material.control));
    return key.hex();
}

/// False where a fault prevented the controls: the next study tries again.
bool isWhole(const nlohmann::ordered_json& json)
{
    return !json.contains("why") || !json["why"].contains("controls") ||
           !json["why"]["controls"].get<std::string>().starts_with("the controls could not be computed");
}

/// Throws nlohmann's exception where the field holds something else than texts.
std::vector<std::string> warningsIn(const nlohmann::ordered_json& signalsOfImages)
{
    if (!signalsOfImages.contains(imageWarningsField)) return {};
    return signalsOfImages.at(imageWarningsField).get<std::vector<std::string>>();
}

/// Whether the report can read what was kept beside images: somebody may have altered it.
bool isReadable(const nlohmann::ordered_json& signalsOfImages)
{
    if (!signalsOfImages.is_object()) return false;
    try {
        (void)warningsIn(signalsOfImages);
        (void)reports::pricesFromJson(signalsOfImages.value(pricesField, nlohmann::ordered_json::array()));
        (void)reports::signalsFromJson(signalsOfImages.dump());
        return true;
    } catch (const nlohmann::ordered_json::exception&) {
        return false;
    } catch (const protocols::Error&) {
        return false;
    }
}

/// Generated against measured signals, beside the controls. The cache gives the comparison of the same images.
nlohmann::ordered_json comparedSignals(const NewStudy& request, const StudyMaterial& material, const std::string& imagesKey,
                                       const database::StudyFacts& facts, const rendering::RenderedFabrics& rendering,
                                       const StudyProgress& progress)
{
    const std::string key = request.cache ? keyOfComparison(request, material, imagesKey, facts) : "";
    if (request.cache)
        if (const auto kept = request.cache->find(key))
            if (auto json = protocols::storedOrderedJson(*kept); isReadable(json)) return json;
    auto json = signalQuality(rendering.signals);
    addControls(json, {material, rendering, facts.datasetSha256, request.seed}, progress.comparison);
    auto lines = describe(imageFaults(rendering), rendering);
    for (auto& line : frictionOutOfReach(rendering)) lines.push_back(std::move(line));
    if (!lines.empty()) json[imageWarningsField] = lines;
    if (request.cache && isWhole(json)) request.cache->keep(key, json.dump());
    return json;
}

/// The study's renderings and, where conditions carry a quality, what each costs and gives up.
struct PricedRendering {
    rendering::RenderedFabrics rendering;
    std::vector<reports::RenderingPrice> prices;
};

PricedRendering pricedRendering(const StudyMaterial& material, const StepProgress& progress)
{
    rendering::RenderRequest request = material.render;
    const auto references = accurateReferences(request.conditions);
    // A price is what the computation takes, so nothing of it may come from the cache.
    if (std::ranges::any_of(request.conditions, [](const auto& id) { return protocols::qualityOf(id).has_value(); }))
        request.cache = nullptr;
    request.conditions.insert(request.conditions.end(), references.begin(), references.end());
    PricedRendering priced{renderFabrics(material.dataset, request, progress), {}};
    priced.prices = renderingPrices(material.render.conditions, priced.rendering, request.mapping.response.get());
    // The references are not shown, so warnings and files do not name them.
    priced.rendering.conditions.resize(material.render.conditions.size());
    return priced;
}

StudyImages rendered(const NewStudy& request, const StudyMaterial& material, const std::string& key,
                     const database::StudyFacts& facts, const StudyProgress& progress)
{
    auto [rendering, prices] = pricedRendering(material, progress.images);
    if (!request.evenStrange) refuseOtherThings(rendering);
    StudyImages images;
    if (progress.stage) progress.stage("comparison of signals");
    auto json = comparedSignals(request, material, key, facts, rendering, progress);
    for (const auto& price : prices) json[pricesField].push_back(priceJson(price));
    images.signalsJson = json.dump();
    for (const auto& line : strangePhotographs(rendering)) images.stamps.push_back(sentence(line));
    for (const auto& line : uncertainFriction(rendering)) images.stamps.push_back(sentence(line));
    for (const auto& line : mixedQuantities(rendering)) images.stamps.push_back(sentence(line));
    images.warnings = warningsIn(json);
    for (const auto& line : shadingWarnings(rendering)) images.warnings.push_back(line);
    for (const auto& line : cutPhotographs(rendering)) images.warnings.push_back(line);
    if (!request.images.empty())
        writeImageFolder(request.images, key, renderJson(material.dataset, material.render, rendering), rendering,
                         images.signalsJson, images.stamps);
    for (auto& condition : rendering.conditions) images.byCondition[condition.condition] = std::move(condition.images);
    return images;
}

bool hasSamplesFor(const Dataset& dataset, const protocols::FabricId& fabric, const std::vector<Signal>& signals)
{
    const auto lacks = [&](Signal signal, Modality modality) {
        return std::find(signals.begin(), signals.end(), signal) != signals.end() &&
               sampleIndices(dataset, fabric, modality).empty();
    };
    return !lacks(Signal::Photograph, Modality::Visual) && !lacks(Signal::TactileFrame, Modality::Tactile) &&
           !lacks(Signal::FrictionRecord, Modality::Friction);
}

}  // namespace

namespace {

StudyImages renderedOrKept(const NewStudy& request, const StudyMaterial& material, const database::StudyFacts& facts,
                           const StudyProgress& progress)
{
    if (material.render.conditions.empty()) return {};
    const std::string key = imageFolderKey(facts, material.render) + (request.evenStrange ? ", even strange" : "");
    if (!request.images.empty())
        if (auto kept = readImageFolder(request.images, key, material.render))
            if (const auto stored = protocols::storedOrderedJson(kept->signalsJson); isReadable(stored))
                return {std::move(kept->images), kept->signalsJson, true, kept->stamps, warningsIn(stored)};
    return rendered(request, material, key, facts, progress);
}

/// One line for each pair of conditions with the same images, of which at least one is the laboratory's own.
std::vector<std::string> sameAsOwn(const StudyImages& images, const OwnImages& own)
{
    if (own.images.empty()) return {};
    rendering::RenderedFabrics all;
    for (const auto& [condition, byFabric] : images.byCondition) {
        rendering::RenderedCondition one;
        one.condition = condition;
        one.images = byFabric;
        all.conditions.push_back(std::move(one));
    }
    rendering::ImageFaults faults = imageFaults(all);
    faults.flat.clear();
    std::erase_if(faults.same,
                  [&](const auto& same) { return !own.images.contains(same.first) && !own.images.contains(same.second); });
    return describe(faults, all);
}

}  // namespace

StudyImages imagesFor(const NewStudy& request, const StudyMaterial& material, const database::StudyFacts& facts,
                      const StudyProgress& progress)
{
    StudyImages images = renderedOrKept(request, material, facts, progress);
    images.byCondition.insert(material.own.images.begin(), material.own.images.end());
    images.warnings.insert(images.warnings.end(), material.own.warnings.begin(), material.own.warnings.end());
    for (std::string& line : sameAsOwn(images, material.own)) images.warnings.push_back(std::move(line));
    return images;
}

FamiliarisationImages familiarisationFor(const NewStudy& request, const StudyMaterial& material)
{
    const Dataset& dataset = material.dataset;
    rendering::RenderRequest render;
    if (material.render.conditions.empty()) return {};
    // The last condition of the protocol is the richest. One image of each fabric is enough for familiarisation.
    render.conditions = {material.render.conditions.back()};
    render.generation.model = request.model;
    render.mapping = material.render.mapping;
    render.cache = request.cache;
    const auto signals = rendering::signalsFor(std::span<const protocols::ConditionId>(render.conditions));
    for (const auto& fabric : dataset.fabrics)
        if (std::find(material.fabrics.begin(), material.fabrics.end(), fabric.id) == material.fabrics.end() &&
            hasSamplesFor(dataset, fabric.id, signals))
            render.fabrics.push_back(fabric.id);
    protocols::Random::stream(request.seed, "fabrics for familiarisation").shuffle(render.fabrics);
    const auto most = static_cast<std::size_t>(material.protocol.familiarisationFabrics);
    if (render.fabrics.size() > most) render.fabrics.resize(most);
    FamiliarisationImages familiarisation;
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

}  // namespace study::making
