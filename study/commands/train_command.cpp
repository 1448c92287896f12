// vis2hap train DATASET --out MODEL ...: passes its options to the second program, which does the work. With --from it adapts a
// model to the data set of a lab.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/utf8.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/models/cloth/cloth_check.h"
#include "rendering/models/fair_control.h"
#include "rendering/models/process/second_program.h"
#include "study/commands/command_line.h"
#include "study/commands/leave_one_out_command.h"
#include "study/commands/parts/progress.h"

namespace study::commands {

namespace {

/// The check of the program was fitted with these; the figures are of another family.
constexpr std::uint64_t checkSeed = 1, checkFamily = 77;
constexpr int checkPictures = 1200, checkFigurePictures = 400;

/// An option with a value, passed on as it is.
struct PassedOption {
    const char* name;
    const char* meaning;
    std::string value;
};

std::vector<PassedOption> passedOptions()
{
    return {
        {"--seed", "seed of the first weights, the batches and the augmentation (default 1)", ""},
        {"--hold-out", "fabrics left out of training, e.g. F02,F09; with DATASET and --from: those that the gain is checked on",
         ""},
        {"--split",
         "what the 8:1:1 split divides: location (default), sample, or augmented (the paper's, in which test copies leak)", ""},
        {"--split-seed", "seed of the split (default 1)", ""},
        {"--threads", "number of threads (default: all); it changes the last bits of sums", ""},
        {"--batch", "photographs per step (default 8)", ""},
        {"--crop", "side of a training crop, px (default 128)", ""},
        {"--channels", "width of the networks (default 16)", ""},
        {"--learning-rate", "learning rate at the start (default 0.001)", ""},
        {"--checkpoint-every", "steps between checkpoints (default 100)", ""},
        {"--validate-every", "steps between validations (default 250)", ""},
        {"--patience", "stop after this many validations without improvement (default 12)", ""},
        {"--stop-at",
         "step to stop at, though the learning rate falls over all --steps (a control of a model that stopped early)", ""},
        {"--validation-pairs", "number of pairs for validation (default 60)", ""},
        {"--from",
         "with DATASET: adapt this model to the data set, for 10 minutes unless told otherwise; with --drawn: start from it", ""},
        {"--towards", "with --drawn and --from: no training; write weights on the way from that model to this one", ""},
        {"--way", "with --towards: share of the way, 0 to 1 (default 0.5)", ""},
        {"--scans", "with --drawn or --from: a data set of `vis2hap import scans`", ""},
        {"--scan-share", "with --scans: share of scanned cloth beside drawn cloth (default 0.3)", ""},
        {"--processes", "with --drawn: number of processes, on one or several machines, that train one model (default 1)", ""},
        {"--rank", "with --processes: number of this process, from 0; rank 0 writes the model", ""},
        {"--master", "with --processes: HOST:PORT at which rank 0 waits for the others", ""},
        {"--wait", "with --processes: longest wait for the other processes, s (default 600)", ""}};
}

struct TrainCall {
    std::string dataset, out, steps, minutes, controlOf;
    std::vector<PassedOption> passed = passedOptions();
    bool clothCheck = false, drawn = false, reference = false, l1Only = false, resume = false, leaveOneOut = false;
    ShardOption shard;
    JsonTarget json;
};

/// Refuses a model whose control could not be trained as it was.
void requireSameTraining(const TrainCall& call, const rendering::models::ModelCardFields& model)
{
    if (call.drawn) {
        if (!model.architecture.sees || !model.datasetHash.empty() || !model.fromHash.empty())
            throw protocols::badInput({"the model was not trained on drawn fabrics alone, from new networks", call.controlOf,
                                       "a model of `vis2hap train --drawn` without --scans and --from",
                                       "name such a model, or name its data set instead of --drawn"});
        return;
    }
    if (model.architecture.sees)
        throw protocols::badInput({"the model was trained on drawn fabrics", call.controlOf, "a model of this data set",
                                   "give --drawn instead of the data set"});
    if (rendering::fabrics::hashOf(rendering::fabrics::readDataset(call.dataset)) != model.datasetHash)
        throw protocols::badInput({"the model was trained on another data set, so this would not be a fair control", call.dataset,
                                   "the data set \"" + model.datasetName + "\" of " + call.controlOf,
                                   "name that data set, or train a control with --l1-only and your own --steps"});
}

/// Options that a control takes from its model, so that both are trained alike.
std::vector<std::string> optionsOfControl(const TrainCall& call)
{
    const auto model = rendering::models::readModelCardFields(call.controlOf);
    requireSameTraining(call, model);
    std::vector<std::string> arguments;
    for (const auto& [name, value] : rendering::models::controlOptions(model)) {
        arguments.push_back(name);
        if (!value.empty()) arguments.push_back(value);
    }
    return arguments;
}

const std::string& valueOf(const TrainCall& call, std::string_view name)
{
    return std::find_if(call.passed.begin(), call.passed.end(), [&](const PassedOption& one) { return one.name == name; })->value;
}

/// Number of threads; 0 where none is named.
unsigned threadsNamed(const std::string& text)
{
    unsigned number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (!text.empty() && (read.ec != std::errc() || read.ptr != text.data() + text.size() || number > 1024))
        throw protocols::badInput({"--threads is \"" + text + "\"", "train", "a whole number", "correct the option"});
    return number;
}

bool adapts(const TrainCall& call) { return !call.drawn && !valueOf(call, "--from").empty(); }

/// A model keeps its networks and losses when it is adapted to a lab.
void refuseOptionsOfNewNetworks(const TrainCall& call)
{
    std::string given;
    for (const char* name : {"--split", "--crop", "--channels", "--patience", "--stop-at", "--validation-pairs",
                             "--validate-every", "--towards", "--way"})
        if (given.empty() && !valueOf(call, name).empty()) given = name;
    for (const auto& [wanted, name] :
         {std::pair{call.reference, "--reference"}, {call.l1Only, "--l1-only"}, {!call.controlOf.empty(), "--control-of"}})
        if (given.empty() && wanted) given = name;
    if (!given.empty())
        throw protocols::badInput({given + " was given together with --from", "train DATASET",
                                   "options that leave the networks and losses of the model as they are",
                                   "leave one of them out"});
}

/// The weights file: of an adaptation beside the data set, unless --out names another.
std::string outOf(const TrainCall& call)
{
    if (!call.out.empty()) return call.out;
    if (call.clothCheck || !adapts(call))
        throw protocols::badInput({"--out is missing", "train", "the weights file to write", "name it with --out MODEL"});
    std::filesystem::path folder = std::filesystem::absolute(call.dataset).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    return folder.string() + ".safetensors";
}

/// Refuses options that belong to another kind of training.
void refuseOptions(const TrainCall& call, std::initializer_list<const char*> names, const std::string& given,
                   const std::string& expected)
{
    for (const char* name : names)
        if (!valueOf(call, name).empty())
            throw protocols::badInput({std::string(name) + " was given " + given, "train", expected, "leave the option out"});
}

std::vector<std::string> argumentsOf(const TrainCall& call)
{
    if (call.drawn != call.dataset.empty())
        throw protocols::badInput({call.drawn ? "both DATASET and --drawn were given" : "neither DATASET nor --drawn was given",
                                   "train", "a data set, or --drawn for fabrics that are drawn without end",
                                   "give one of them; scans join drawn fabrics by --scans DATASET"});
    if (call.drawn)
        refuseOptions(call, {"--split", "--split-seed", "--patience", "--stop-at", "--validation-pairs"}, "together with --drawn",
                      "a training of a data set, whose samples are split");
    else
        refuseOptions(call, {"--processes", "--rank", "--master", "--wait"}, "together with DATASET",
                      "a training with --drawn, or one process");
    if (adapts(call))
        refuseOptionsOfNewNetworks(call);
    else if (!call.drawn)
        refuseOptions(call, {"--towards", "--way", "--scans", "--scan-share"}, "together with DATASET",
                      "a training with --drawn, or an adaptation with --from");
    std::vector<std::string> arguments{call.drawn || adapts(call) ? "train-cloth" : "train"};
    if (adapts(call))
        arguments.insert(arguments.end(), {"--lab", call.dataset});
    else if (!call.drawn)
        arguments.push_back(call.dataset);
    arguments.insert(arguments.end(), {"--out", outOf(call)});
    const auto pass = [&](const char* name, const std::string& value) {
        if (!value.empty()) arguments.insert(arguments.end(), {name, value});
    };
    pass("--steps", call.steps);
    pass("--minutes", call.minutes);
    for (const PassedOption& one : call.passed) pass(one.name, one.value);
    for (const auto& [wanted, name] :
         {std::pair{call.reference, "--reference"}, {call.l1Only, "--l1-only"}, {call.resume, "--resume"}})
        if (wanted) arguments.emplace_back(name);
    if (!call.controlOf.empty())
        for (std::string& argument : optionsOfControl(call)) arguments.push_back(std::move(argument));
    for (const std::string& argument : arguments)  // the model card keeps them
        if (protocols::firstByteThatIsNotUtf8(argument))
            throw protocols::badInput({"the path is not UTF-8", argument, "a path in UTF-8", "rename the folder or file"});
    return arguments;
}

/// A training without each fabric. All trainings of a table have the same number of steps.
int trainWithoutEach(const TrainCall& call)
{
    for (const auto& [wanted, name] : {std::pair{call.drawn, "--drawn"},
                                       {adapts(call), "--from"},
                                       {!call.controlOf.empty(), "--control-of"},
                                       {!call.minutes.empty(), "--minutes"},
                                       {!valueOf(call, "--hold-out").empty(), "--hold-out"}})
        if (wanted)
            throw protocols::badInput({std::string(name) + " was given together with --leave-one-out", "train",
                                       "train DATASET --leave-one-out --out FOLDER, with --steps", "leave the option out"});
    LeaveOneOutCall each{call.dataset, outOf(call), {}, 0, call.resume, call.shard, call.json};
    TrainCall common = call;
    common.resume = false;
    for (PassedOption& one : common.passed)
        if (std::string_view(one.name) == "--threads") {
            each.threads = threadsNamed(one.value);
            one.value.clear();
        }
    const std::vector<std::string> words = argumentsOf(common);
    each.arguments.assign(words.begin() + 4, words.end());  // Behind train DATASET --out FOLDER.
    return leaveOneOut(each);
}

int fitCheck(const TrainCall& call)
{
    if (!call.dataset.empty() || call.drawn)
        throw protocols::badInput(
            {"--cloth-check takes no data set", "train", "train --cloth-check --out FILE", "leave the data set and --drawn out"});
    const std::string out = outOf(call);
    const auto check = [&] {
        Progress progress("pictures");
        return rendering::models::fitClothCheck(checkSeed, checkPictures, 0,
                                                [&](int done, int total) { progress.show(done, total, "pictures"); });
    }();
    rendering::models::writeClothCheck(out, check);
    const auto figures = rendering::models::clothCheckFigures(check, checkFamily, checkFigurePictures);
    std::printf("of %d drawn photographs that the fit did not see, %.1f %% are refused and %.1f %% unusual\n",
                checkFigurePictures, 100 * figures.clothRefused, 100 * figures.clothUnusual);
    std::printf("of %d drawn pictures of other things, %.1f %% are refused\nwrote %s\n", checkFigurePictures,
                100 * figures.othersRefused, protocols::printable(out).c_str());
    return 0;
}

}  // namespace

void addTrain(CLI::App& app, Action& action)
{
    auto call = std::make_shared<TrainCall>();
    auto* command = app.add_subcommand("train", "train the generators on a data set, or adapt a model to it (uses libtorch)");
    command->add_option("DATASET", call->dataset, "the data set");
    command->add_flag("--drawn", call->drawn, "train networks for any cloth on drawn fabrics, none of which is shown twice");
    command->add_option(
        "--out", call->out,
        "weights file to write, with MODEL.json and the folder MODEL.log beside it (needed; with DATASET and --from "
        "DATASET.safetensors)");
    auto* steps =
        command->add_option("--steps", call->steps, "training steps (default 5000); the same number gives the same weights");
    command->add_option("--minutes", call->minutes, "minutes of training instead of a number of steps")->excludes(steps);
    for (PassedOption& one : call->passed) command->add_option(one.name, one.value, one.meaning);
    auto* reference = command->add_flag("--reference", call->reference, "use the losses of the paper, also with --drawn");
    auto* l1Only =
        command
            ->add_flag("--l1-only", call->l1Only, "use only the L1 loss of the paper, also with --drawn: a control for evaluate")
            ->excludes(reference);
    auto* controlOf = command
                          ->add_option("--control-of", call->controlOf,
                                       "train the L1-only control of this model: with its steps, seed, split, held-out fabrics, "
                                       "batch, validations and networks")
                          ->excludes(steps)
                          ->excludes(reference)
                          ->excludes(l1Only);
    for (const char* taken : {"--minutes", "--seed", "--hold-out", "--split", "--split-seed", "--batch", "--crop", "--channels",
                              "--learning-rate", "--patience", "--validate-every", "--stop-at"})
        controlOf->excludes(command->get_option(taken));
    command->add_flag(
        "--leave-one-out", call->leaveOneOut,
        "train without each fabric in turn, test each model on this fabric, and print a table; --out names a folder");
    addShardOptions(*command, call->shard);
    addJsonOption(*command, call->json);
    command->add_flag("--resume", call->resume, "continue from the last checkpoint");
    command->add_flag("--cloth-check", call->clothCheck,
                      "fit the check that a photograph shows cloth, to drawn cloth and drawn other pictures");
    command->callback([call, &action] {
        action.work = [call] {
            if (call->clothCheck) return fitCheck(*call);
            if (call->leaveOneOut) return trainWithoutEach(*call);
            if (call->shard.isGiven() || call->json)
                throw protocols::badInput({"one training has no shards and no table", "train",
                                           "--leave-one-out, which trains without each fabric in turn",
                                           "leave --shard and --json out, or add --leave-one-out"});
            return rendering::models::runSecondProgram(argumentsOf(*call));
        };
    });
}

}  // namespace study::commands
