// vis2hap evaluate DATASET: generated against measured signals, beside their controls.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "rendering/fabrics/recordings/import_sources.h"
#include "rendering/fabrics/recordings/photograph_files.h"
#include "rendering/models/cloth/cloth_check.h"
#include "rendering/models/exchange.h"
#include "stats/kernels/threads.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/explanation.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/number_checks.h"
#include "study/commands/parts/progress.h"
#include "study/evaluation/evaluation_json.h"
#include "study/evaluation/evaluation_text.h"
#include "study/evaluation/photograph_changes.h"
#include "study/evaluation/surfaces.h"
#include "study/evaluation/weaves.h"
#include "study/looking/picture_decoder.h"

namespace study::commands {

namespace {

namespace evaluation = study::evaluation;

constexpr unsigned mostThreads = 16;  ///< each thread holds its own maps and spectra

struct EvaluateCall {
    std::string dataset, model, split, quality = "balanced";
    std::vector<std::string> against;
    std::optional<std::uint64_t> splitSeed;
    std::optional<int> samples;
    double bounds = 0.10;
    bool clothCheck = false, changes = false, fibreUntold = false;
    JsonTarget json;
};

const std::map<std::string, evaluation::SplitKind> splits{{"sample", evaluation::SplitKind::Sample},
                                                          {"location", evaluation::SplitKind::Location},
                                                          {"fabric", evaluation::SplitKind::Fabric},
                                                          {"augmented", evaluation::SplitKind::Augmented}};

bool hasMeasurements(const rendering::fabrics::Dataset& dataset)
{
    using rendering::fabrics::Modality;
    return std::ranges::any_of(dataset.fabrics, [&](const auto& fabric) {
        return !rendering::fabrics::sampleIndices(dataset, fabric.id, Modality::Tactile).empty() ||
               !rendering::fabrics::sampleIndices(dataset, fabric.id, Modality::Friction).empty();
    });
}

/// The pictures below a folder, or the one picture that is named.
std::vector<std::filesystem::path> picturesOf(const std::string& place)
{
    std::vector<std::filesystem::path> files;
    const auto endings = rendering::fabrics::photographEndings();
    if (!std::filesystem::is_directory(place)) return {place};
    for (std::filesystem::recursive_directory_iterator entry(place), end; entry != end; ++entry)
        if (rendering::fabrics::isHidden(entry->path()))
            entry.disable_recursion_pending();
        else if (const std::string ending = rendering::fabrics::lowerCase(entry->path().extension().string());
                 entry->is_regular_file() && std::ranges::find(endings, ending) != endings.end())
            files.push_back(entry->path());
    if (files.empty())
        throw protocols::badInput({"there are no pictures", place, "PNG, JPEG or TIFF files", "name another folder"});
    std::ranges::sort(files);
    return files;
}

/// Shows the stages of a piece of work, and takes their times.
template <class Work>
auto withStages(StageTimes& times, const Work& work)
{
    StagesShown stages;
    return work([&](const std::string& stage, int done, int total) {
        times.begin(stage);
        stages.show(stage, done, total);
    });
}

/// Prints the text; false where JSON stays alone on standard output.
template <class Text>
bool printText(const EvaluateCall& call, const Text& text)
{
    if (call.json && call.json->empty()) return false;
    std::fputs(protocols::printableLines(text()).c_str(), stdout);
    return true;
}

/// Whether pictures show cloth; a file that cannot be read is named and left out.
int checkPictures(const EvaluateCall& call)
{
    const auto& check = rendering::models::shippedClothCheck();
    std::map<std::string, int> counts;
    auto pictures = nlohmann::ordered_json::array();
    std::string lines;
    for (const auto& file : picturesOf(call.dataset)) {
        std::string likeness = "unreadable", fault;
        nlohmann::ordered_json score;
        try {
            score = check.score(rendering::fabrics::readPhotographFile(file, looking::decodeByQt));
            likeness = nameOf(check.likenessOf(score.get<double>()));
        } catch (const protocols::Error& unreadable) {
            fault = unreadable.what();
        }
        ++counts[likeness];
        pictures.push_back({{"file", file.string()}, {"likeness", likeness}, {"score", score}});
        if (score.is_null()) pictures.back()["why"] = {{"score", fault}};
        lines += likeness + std::string(12 - likeness.size(), ' ') + file.string() + "\n";
    }
    for (const auto& [likeness, count] : counts) lines += likeness + ": " + std::to_string(count) + "\n";
    if (call.json) writeJson(call.json, {{"schema", "vis2hap.cloth_likeness/1"}, {"pictures", pictures}});
    printText(call, [&] { return lines; });
    return 0;
}

/// An option that changes nothing is refused: `--split fabric` would look like a test on fabrics that were held out.
void refuseOptions(const CLI::App& command, std::initializer_list<const char*> names, const std::string& reason)
{
    for (const char* name : names)
        if (command.count(name) > 0)
            throw protocols::badInput(
                {std::string(name) + " changes nothing here: " + reason, "evaluate", "options that apply", "leave it out"});
}

int evaluate(const EvaluateCall& call, const CLI::App& command, StageTimes times)
{
    if (call.clothCheck) return checkPictures(call);
    auto dataset = rendering::fabrics::readDataset(call.dataset);
    if (call.fibreUntold)
        for (auto& fabric : dataset.fabrics) fabric.fibre.reset();
    evaluation::EvaluationRequest request;
    request.model = call.model;
    request.against.assign(call.against.begin(), call.against.end());
    if (!call.split.empty()) request.split = splits.at(call.split);
    request.splitSeed = call.splitSeed;
    request.quality = rendering::models::qualityNamed(call.quality);
    request.samplesPerFabric = call.samples;
    request.boundsFraction = call.bounds;
    request.threads = std::min(stats::threadCount(0), mostThreads);
    if (call.changes) {
        refuseOptions(command, {"--against", "--split", "--split-seed", "--bounds"},
                      "--changes compares photographs with themselves");
        const auto changes =
            withStages(times, [&](const auto& show) { return evaluation::evaluateChanges(dataset, request, show); });
        if (call.json) writeJson(call.json, evaluation::changesJson(changes));
        if (printText(call, [&] { return evaluation::changesText(changes); })) times.end();
        return 0;
    }
    if (!hasMeasurements(dataset))
        refuseOptions(command, {"--against", "--split", "--split-seed", "--bounds"},
                      "the data set has no presses and no strokes, so nothing is split");
    std::optional<evaluation::SurfaceReport> surfaces;
    if (evaluation::hasSurfaces(dataset)) {
        surfaces = withStages(times, [&](const auto& show) { return evaluation::evaluateSurfaces(dataset, request, show); });
        const bool isAll = !hasMeasurements(dataset);
        if (call.json && isAll) writeJson(call.json, evaluation::surfacesJson(*surfaces));
        const bool isPrinted = printText(call, [&] { return evaluation::surfacesText(*surfaces); });
        if (isAll && isPrinted) times.end();
        if (isAll) return 0;
    }
    if (!hasMeasurements(dataset)) {
        refuseOptions(command, {"--samples"}, "every photograph is compared with its own relief");
        const auto weaves =
            withStages(times, [&](const auto& show) { return evaluation::evaluateWeaves(dataset, request, show); });
        if (call.json) writeJson(call.json, evaluation::weavesJson(weaves));
        if (printText(call, [&] { return evaluation::weavesText(weaves); })) times.end();
        return 0;
    }
    const evaluation::Evaluation result =
        withStages(times, [&](const auto& show) { return evaluation::evaluate(dataset, request, show); });
    if (call.json) {
        auto json = evaluation::evaluationJson(result);
        if (surfaces) json["surfaces"] = evaluation::surfacesJson(*surfaces).at("surfaces");
        writeJson(call.json, json);
    }
    if (printText(call, [&] { return evaluation::evaluationText(result); })) times.end();
    return 0;
}

}  // namespace

void addEvaluate(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("evaluate", "compare generated with measured signals, beside controls");
    auto call = std::make_shared<EvaluateCall>();
    command->add_option("DATASET", call->dataset, "the data set")->required();
    command->add_option("--model", call->model, "weights (default: the shipped ones)");
    command->add_option("--against", call->against, "further weights to evaluate on the same test samples");
    command
        ->add_option("--split", call->split,
                     "sample: the paper's split; location: no place occurs in both training and test; "
                     "fabric: fabrics held out from training; augmented: copies of a sample in every part (default: location "
                     "for a model that was so trained on this data set, else sample)")
        ->check(CLI::IsMember({"sample", "location", "fabric", "augmented"}));
    command->add_option("--split-seed", call->splitSeed, "seed of the split (default: that of the model)");
    command->add_option("--quality", call->quality, "quality of the generators")
        ->check(CLI::IsMember({"fast", "balanced", "accurate"}))
        ->capture_default_str();
    command
        ->add_option("--samples", call->samples,
                     "test photographs per fabric (default: all; 4 a light where surfaces are known; 1 with --changes)")
        ->check(CLI::Range(1, 100000));
    command->add_option("--bounds", call->bounds, "equivalence bounds of means, as a fraction of the measured mean")
        ->check(finiteIn(1e-6, 1))
        ->capture_default_str();
    command->add_flag("--cloth-check", call->clothCheck, "only say of each picture in the folder DATASET whether it shows cloth");
    command->add_flag("--changes", call->changes,
                      "only say how much dye, light, focus and noise of a photograph change what is generated from it");
    command->add_flag("--fibre-untold", call->fibreUntold, "do not tell the generators the fibres that dataset.json states");
    addJsonOption(*command, call->json);
    command->callback([call, command, &action] {
        action.work = [call, command] { return evaluate(*call, *command, StageTimes(isExplained(*command))); };
    });
}

}  // namespace study::commands
