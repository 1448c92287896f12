#include "rendering/models/model_card_fields.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/json_count.h"

namespace rendering::models {

namespace {

using nlohmann::ordered_json;
using protocols::countIn;
using protocols::seedIn;

constexpr const char* schema = "vis2hap.model/2";
/// Changes whenever networks.cpp or the meaning of the networks' inputs and outputs changes.
constexpr const char* architectureKind = "unet+summary/3";
/// The same for seeing_networks.cpp.
constexpr const char* seeingKind = "seeing/1";
/// Cards of the shipped weights have less than 1 MB.
constexpr std::uint64_t largestCard = protocols::largestJson, largestWeights = std::uint64_t{1} << 30;
/// Parameters of the one layer whose size grows with the spectrogram; the shipped weights have 73,728.
constexpr double mostSeedParameters = 1 << 27;

ordered_json fibresJson(const FibreReadings& readings)
{
    ordered_json json = ordered_json::object();
    for (std::size_t i = 0; i < readings.size(); ++i)
        if (const auto& one = readings[i])
            json[nameOf(fabrics::Fibre(i))] = {{"constant", one->constant}, {"gain", one->gain}, {"narrowing", one->narrowing}};
    return json;
}

/// Names of other fibres are skipped: a later program may know more of them.
FibreReadings fibresFrom(const ordered_json& json)
{
    FibreReadings readings;
    for (const auto& [name, one] : json.items())
        if (const auto fibre = fabrics::fibreFrom(name))
            readings[std::size_t(*fibre)] =
                FibreReading{one.at("constant").get<double>(), one.at("gain").get<double>(), one.at("narrowing").get<double>()};
    return readings;
}

ordered_json architectureJson(const Architecture& a)
{
    const ordered_json spectrogram{{"window", a.window}, {"hop", a.hop},       {"samples", a.traceSamples},
                                   {"rows", a.rows},     {"frames", a.frames}, {"mm_per_sample", a.traceMmPerSample}};
    if (a.sees) {
        ordered_json json{{"kind", seeingKind}, {"base_channels", a.baseChannels},     {"friction_channels", a.frictionChannels},
                          {"crop", a.crop},     {"interval_factor", a.intervalFactor}, {"spectrogram", spectrogram}};
        if (a.frictionFactor != 1 || a.reliefFactor != 1)
            json["lab_factors"] = {{"friction", a.frictionFactor}, {"relief", a.reliefFactor}};
        if (const ordered_json fibres = fibresJson(a.fibres); !fibres.empty()) json["fibres"] = fibres;
        return json;
    }
    return {{"kind", architectureKind},
            {"base_channels", a.baseChannels},
            {"crop", a.crop},
            {"mm_per_pixel", a.mmPerPixel},
            {"height_scale_mm", a.heightScaleMm},
            {"imposes_spectrum", a.imposesSpectrum},
            {"zero_percentile", a.zeroPercentile},
            {"mean_friction_scale", a.meanFrictionScale},
            {"spectrogram", spectrogram}};
}

Architecture architectureFrom(const ordered_json& json)
{
    Architecture a;
    a.sees = json.at("kind").get<std::string>() == seeingKind;
    a.baseChannels = countIn(json, "base_channels");
    a.crop = countIn(json, "crop");
    if (a.sees) {
        a.frictionChannels = countIn(json, "friction_channels");
        a.imposesSpectrum = false;
        a.intervalFactor = json.value("interval_factor", 1.0);
        if (json.contains("fibres")) a.fibres = fibresFrom(json.at("fibres"));
        if (json.contains("lab_factors")) {
            a.frictionFactor = json.at("lab_factors").at("friction").get<double>();
            a.reliefFactor = json.at("lab_factors").at("relief").get<double>();
        }
    } else {
        a.mmPerPixel = json.at("mm_per_pixel").get<double>();
        a.heightScaleMm = json.at("height_scale_mm").get<double>();
        a.imposesSpectrum = json.at("imposes_spectrum").get<bool>();
        a.zeroPercentile = json.at("zero_percentile").get<double>();
        a.meanFrictionScale = json.at("mean_friction_scale").get<double>();
    }
    const ordered_json& spectrogram = json.at("spectrogram");
    a.window = countIn(spectrogram, "window");
    a.hop = countIn(spectrogram, "hop");
    a.traceSamples = countIn(spectrogram, "samples");
    a.rows = countIn(spectrogram, "rows");
    a.frames = countIn(spectrogram, "frames");
    a.traceMmPerSample = spectrogram.at("mm_per_sample").get<double>();
    return a;
}

bool sensible(const FibreReadings& readings)
{
    return std::ranges::all_of(readings, [](const std::optional<FibreReading>& one) {
        return !one || (std::abs(one->constant) <= 10 && one->gain >= 0.01 && one->gain <= 100 && one->narrowing >= 0.01 &&
                        one->narrowing <= 100);
    });
}

/// Refuses absurd sizes before memory is allocated for them.
bool sensible(const Architecture& a)
{
    const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
    return within(a.baseChannels, 1, mostChannels) && within(a.frictionChannels, 1, mostChannels) &&
           within(a.crop, 16, largestCrop) && a.crop % 16 == 0 && within(a.mmPerPixel, 1e-5, 100) &&
           within(a.heightScaleMm, 1e-9, 1e3) && within(a.meanFrictionScale, 1e-9, 1e3) && within(a.window, 4, 4096) &&
           within(a.hop, 1, a.window) && within(a.traceSamples, 4, 1 << 20) && within(a.rows, 2, 2049) &&
           within(a.frames, 1, 1 << 16) && within(a.traceMmPerSample, 1e-9, 1e3) && within(a.zeroPercentile, 0, 50) &&
           within(a.intervalFactor, 0.1, 10) && sensible(a.fibres) && within(a.frictionFactor, 0.01, 100) &&
           within(a.reliefFactor, 0.01, 100) &&
           0.25 * std::pow(std::max(a.baseChannels, a.frictionChannels), 2) * (a.rows + 3.0) * (a.frames + 3.0) <=
               mostSeedParameters;
}

/// Older cards do not list them; their networks for any cloth drew fabrics by the seed of the training.
std::set<std::uint64_t> drawnSeedsIn(const ordered_json& json, const ModelCardFields& card)
{
    if (!json.contains("drawn_seeds"))
        return card.architecture.sees ? std::set<std::uint64_t>{card.seed} : std::set<std::uint64_t>();
    std::set<std::uint64_t> seeds;
    for (const ordered_json& seed : json.at("drawn_seeds").get_ref<const ordered_json::array_t&>())
        seeds.insert(protocols::wholeOf<std::uint64_t>(seed));
    return seeds;
}

protocols::Error notUsable(const std::filesystem::path& card, const std::string& why)
{
    return protocols::badInput({"the model card cannot be used: " + why, card.string(), std::string("a card of schema ") + schema,
                                "copy the weights together with the .json file that `vis2hap train` wrote"});
}

}  // namespace

std::filesystem::path cardOf(const std::filesystem::path& model)
{
    std::filesystem::path card = model;
    card += ".json";
    return card;
}

std::string cardText(const ModelCardFields& card)
{
    ordered_json json{{"schema", schema},
                      {"name", card.summary.name},
                      {"sha256", card.summary.sha256},
                      {"training_command", card.summary.trainingCommand},
                      {"procedural", card.summary.trainedOnProceduralSet},
                      {"dataset", {{"name", card.datasetName}, {"sha256", card.datasetHash}}},
                      {"losses", card.objective},
                      {"split", card.split},
                      {"seed", card.seed},
                      {"split_seed", card.splitSeed},
                      {"steps", card.steps},
                      {"best_step", card.bestStep},
                      {"training_minutes", card.trainingMinutes},
                      {"held_out", card.heldOut},
                      {"architecture", architectureJson(card.architecture)},
                      {"validation", ordered_json::parse(card.validationJson)}};
    if (!card.fromHash.empty()) json["from"] = {{"name", card.fromName}, {"sha256", card.fromHash}};
    if (!card.summary.drawnSeeds.empty()) json["drawn_seeds"] = card.summary.drawnSeeds;
    json["training_sample_hashes"] = card.summary.trainingSampleHashes;
    return json.dump(1) + "\n";
}

ModelCardFields readModelCardFields(const std::filesystem::path& model)
{
    const std::filesystem::path file = cardOf(model);
    std::error_code none;
    if (!std::filesystem::exists(file, none))
        throw protocols::badInput({"the model card is missing", file.string(),
                                   "the .json that `vis2hap train` writes beside the weights", "copy it beside the weights"});
    const std::string text = protocols::readRegularFile(file, largestCard);
    ModelCardFields card;
    try {
        const ordered_json json = protocols::parseStrictOrderedJson(text, file.string());
        if (json.at("schema").get<std::string>() != schema)
            throw notUsable(file, "its schema is " + json.at("schema").get<std::string>());
        card.summary.name = json.at("name").get<std::string>();
        card.summary.sha256 = json.at("sha256").get<std::string>();
        card.summary.trainingCommand = json.at("training_command").get<std::string>();
        card.summary.trainedOnProceduralSet = json.at("procedural").get<bool>();
        card.summary.trainingSampleHashes = json.at("training_sample_hashes").get<std::vector<std::string>>();
        std::ranges::sort(card.summary.trainingSampleHashes);
        card.datasetName = json.at("dataset").at("name").get<std::string>();
        card.datasetHash = json.at("dataset").at("sha256").get<std::string>();
        if (json.contains("from")) {
            card.fromName = json.at("from").at("name").get<std::string>();
            card.fromHash = json.at("from").at("sha256").get<std::string>();
        }
        card.objective = json.at("losses").get<std::string>();
        card.split = json.at("split").get<std::string>();
        card.bestStep = countIn(json, "best_step");
        card.seed = seedIn(json, "seed");
        card.splitSeed = seedIn(json, "split_seed");
        card.steps = countIn(json, "steps");
        card.trainingMinutes = json.at("training_minutes").get<double>();
        card.heldOut = json.at("held_out").get<std::vector<std::string>>();
        const auto kind = json.at("architecture").at("kind").get<std::string>();
        if (kind != architectureKind && kind != seeingKind)
            throw notUsable(file, "its networks differ from those of this program");
        card.architecture = architectureFrom(json.at("architecture"));
        card.summary.drawnSeeds = drawnSeedsIn(json, card);
        card.validationJson = json.at("validation").dump();
    } catch (const ordered_json::exception& fault) {
        throw notUsable(file, fault.what());
    } catch (const std::out_of_range& fault) {
        throw notUsable(file, fault.what());
    }
    if (!sensible(card.architecture)) throw notUsable(file, "its architecture has sizes out of range");
    return card;
}

TensorSource weightsSource(const std::filesystem::path& model)
{
    return {model, "a weights file from `vis2hap train`",
            "use the weights of the program, or train again with the command in the model card"};
}

void checkWeightsFile(const std::filesystem::path& model, const ModelCardFields& card)
{
    std::error_code none;
    if (!std::filesystem::exists(model, none))
        throw protocols::badInput(
            {"the weights are missing", model.string(), "a weights file from `vis2hap train`", "check the path of the model"});
    refuseArchive(weightsSource(model));
    requireHashOfCard(model, protocols::readRegularFile(model, largestWeights), card);
}

void requireHashOfCard(const std::filesystem::path& model, std::string_view bytes, const ModelCardFields& card)
{
    if (protocols::sha256(bytes) != card.summary.sha256)
        throw protocols::badInput({"the weights are truncated or altered", model.string(),
                                   "the SHA-256 that the model card states", "copy the weights again together with their .json"});
}

}  // namespace rendering::models
