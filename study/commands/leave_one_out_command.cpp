#include "study/commands/leave_one_out_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/process/child_process.h"
#include "stats/kernels/threads.h"
#include "study/commands/parts/progress.h"
#include "study/evaluation/left_out/leave_one_out.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using rendering::fabrics::Dataset;

constexpr const char* leaveOneOutName = "train";
constexpr std::size_t fewestFabrics = 2;

std::string textOf(const std::vector<std::string>& words)
{
    std::string text = "vis2hap";
    for (const std::string& word : words) text += " " + word;
    return text;
}

/// The words of the training without this fabric. They name the number of threads, on which the last bits depend.
std::vector<std::string> wordsOf(const LeaveOneOutCall& call, const std::string& fabric, const fs::path& model)
{
    std::vector<std::string> words{"train", call.dataset, "--out", model.string(), "--hold-out", fabric};
    words.insert(words.end(), {"--threads", std::to_string(stats::threadCount(call.threads))});
    words.insert(words.end(), call.arguments.begin(), call.arguments.end());
    return words;
}

/// True for a model that this very training has finished. Throws badInput for another model in its place.
bool isFinished(const fs::path& model, const std::vector<std::string>& words, const std::string& datasetHash)
{
    if (!fs::exists(model)) return false;
    const auto card = rendering::models::readModelCardFields(model);
    if (card.datasetHash != datasetHash)
        throw protocols::badInput({"the data set has changed since this model was trained", model.string(),
                                   "a model of the data set as it is", "name another folder with --out, or leave --resume out"});
    if (card.summary.trainingCommand == textOf(words)) return true;
    throw protocols::badInput({"another training wrote this model", model.string(), "a model of: " + textOf(words),
                               "name another folder with --out, or leave --resume out"});
}

/// The test of a fabric takes the testing part of its photographs, which must not be empty.
void requirePhotographs(const Dataset& dataset)
{
    namespace fabrics = rendering::fabrics;
    std::set<protocols::FabricId> tested;
    for (const auto& [place, part] : fabrics::splitBySample(dataset, 1))
        if (place.modality == fabrics::Modality::Visual && part == fabrics::Part::Testing) tested.insert(place.fabric);
    for (const auto& fabric : dataset.fabrics)
        if (!tested.contains(fabric.id))
            throw protocols::badInput({"fabric " + fabric.id.value + " has too few photographs to be tested",
                                       dataset.folder.string(),
                                       "photographs of at least three groups (samples.csv) of each fabric",
                                       "import more, or train on a data set without this fabric"});
}

/// `datasetHash`: of the data set as it is; needed where `call` resumes.
evaluation::LeftOutFabric trainedWithout(const LeaveOneOutCall& call, const Dataset& dataset, const std::string& datasetHash,
                                         const std::string& fabric)
{
    const fs::path model = fs::path(call.folder) / (fabric + ".safetensors");
    std::vector<std::string> words = wordsOf(call, fabric, model);
    if (!call.resume || !isFinished(model, words, datasetHash)) {
        if (call.resume && fs::exists(model.string() + ".checkpoint")) words.emplace_back("--resume");
        rendering::models::runGeneratorProgram(words, fs::path(call.folder) / (fabric + ".txt"),
                                               rendering::models::trainingLimits());
    }
    evaluation::EvaluationRequest request;
    request.model = model;
    request.split = evaluation::SplitKind::Fabric;
    request.threads = call.threads;
    return evaluation::leftOutFabric(evaluation::evaluate(dataset, request));
}

void show(const evaluation::LeaveOneOut& result, const JsonTarget& target)
{
    if (target)
        writeJson(target, leaveOneOutJson(result));
    else
        std::fputs(protocols::printableLines(leaveOneOutText(result)).c_str(), stdout);
}

ordered_json optionsOf(const LeaveOneOutCall& call, const Dataset& dataset)
{
    ordered_json fabrics = ordered_json::array();
    for (const auto& fabric : dataset.fabrics) fabrics.push_back(fabric.id.value);
    return {{"kind", "leave-one-out"}, {"dataset", dataset.name},     {"dataset_sha256", rendering::fabrics::hashOf(dataset)},
            {"fabrics", fabrics},      {"arguments", call.arguments}, {"threads", stats::threadCount(call.threads)}};
}

/// The values of each shard, sorted: an object that keeps the order of its keys looks through all of them for each.
std::vector<std::map<std::string, const ordered_json*>> valuesByName(const shards::ShardedRun& run)
{
    std::vector<std::map<std::string, const ordered_json*>> all(run.shards.size());
    for (std::size_t shard = 0; shard < run.shards.size(); ++shard)
        for (const auto& [name, value] : run.shards[shard].values.items()) all[shard][name] = &value;
    return all;
}

}  // namespace

int leaveOneOut(const LeaveOneOutCall& call)
{
    const stats::Share share = shareOf(call.shard, leaveOneOutName, call.target);
    const Dataset dataset = rendering::fabrics::readDataset(call.dataset);
    if (dataset.fabrics.size() < fewestFabrics)
        throw protocols::badInput({"the data set has too few fabrics to leave one out", call.dataset,
                                   "at least " + std::to_string(fewestFabrics) + " fabrics", "name another data set"});
    requirePhotographs(dataset);
    fs::create_directories(call.folder);
    const std::string datasetHash = call.resume ? rendering::fabrics::hashOf(dataset) : std::string();
    evaluation::LeaveOneOut result{dataset.name, {}};
    ordered_json values = ordered_json::object();
    const std::size_t own = share.sizeOf(dataset.fabrics.size());
    {
        Progress progress("trainings");
        for (std::size_t i = 0; i < own; ++i) {
            const std::string fabric = dataset.fabrics[share.item(i)].id.value;
            progress.show(static_cast<int>(i), static_cast<int>(own), "without " + fabric);
            result.fabrics.push_back(trainedWithout(call, dataset, datasetHash, fabric));
            values[fabric] = leftOutJson(result.fabrics.back());
        }
        progress.show(static_cast<int>(own), static_cast<int>(own));
    }
    if (call.shard.isGiven())
        writeShard(call.shard, leaveOneOutName, optionsOf(call, dataset), std::move(values));
    else
        show(result, call.target);
    return 0;
}

void mergeLeaveOneOut(const shards::ShardedRun& run, const MergeOutput& output)
{
    requireNoFolder(output);
    const std::string where = run.files.front().string();
    evaluation::LeaveOneOut result;
    try {
        result.dataset = run.options().at("dataset").get<std::string>();
        const auto valuesOf = valuesByName(run);
        std::set<std::string> named;
        std::size_t place = 0;
        for (const ordered_json& fabric : run.options().at("fabrics")) {
            const std::size_t shard = place++ % run.shards.size();
            const auto name = fabric.get<std::string>();
            const auto value = valuesOf[shard].find(name);
            if (!named.insert(name).second || value == valuesOf[shard].end())
                throw ordered_json::other_error::create(501, "a fabric twice, or one that is missing", nullptr);
            result.fabrics.push_back(evaluation::leftOutFrom(*value->second, run.files[shard].string()));
            if (result.fabrics.back().predictors.size() != result.fabrics.front().predictors.size())
                throw ordered_json::other_error::create(501, "other predictors", nullptr);
        }
    } catch (const ordered_json::exception&) {
        throw protocols::badInput({"the shards do not hold every fabric of the data set", where,
                                   "shards as `vis2hap train --leave-one-out` writes them", "run the shards again"});
    }
    show(result, output.json);
}

}  // namespace study::commands
