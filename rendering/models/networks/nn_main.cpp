// vis2hap-nn: the second executable, the only one that loads libtorch. `vis2hap train` and the first generated signal
// start it; it can also be called by hand.
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/process/kept_memory.h"
#include "protocols/process/whole_number_options.h"
#include "rendering/models/exchange.h"
#include "rendering/models/lab/lab_training.h"
#include "rendering/models/networks/inference.h"
#include "rendering/models/networks/nn_bench.h"
#include "rendering/models/networks/paper_objective.h"
#include "rendering/models/networks/peer_step.h"
#include "rendering/models/networks/training.h"
#include "rendering/models/process/child_process.h"
#include "rendering/models/seeing/cloth_training.h"

namespace {

using namespace rendering;

/// The flags of the paper's losses.
struct ObjectiveFlags {
    bool reference = false, l1Only = false;

    void offer(CLI::App& train)
    {
        train.add_flag("--reference", reference, "use exactly the losses of the paper");
        train.add_flag("--l1-only", l1Only, "use only the paper's L1 loss, without a discriminator: a control for evaluate");
    }
    models::Objective chosen() const
    {
        if (reference && l1Only)
            throw protocols::badInput(
                {"both --reference and --l1-only were given", "train", "only one of them", "omit one of them"});
        return reference ? models::Objective::Reference : l1Only ? models::Objective::L1Only : models::Objective::Default;
    }
};

void offerTraining(CLI::App& app, const std::string& command)
{
    struct TrainingCall {
        std::string dataset;
        models::TrainingOptions options;
        std::vector<std::string> heldOut;
        int steps = 0;
        double minutes = 0;
        ObjectiveFlags losses;
    };
    auto call = std::make_shared<TrainingCall>();
    CLI::App* train = app.add_subcommand("train", "train the generators on a data set");
    models::TrainingOptions& options = call->options;
    train->add_option("DATASET", call->dataset, "folder with photographs, GelSight frames and friction records")->required();
    train->add_option("--out", options.out, "weights file; its model card is written to MODEL.json")->required();
    CLI::Option* steps = train->add_option("--steps", call->steps, "optimisation steps (default 5000)");
    CLI::Option* minutes = train->add_option("--minutes", call->minutes, "wall time instead of steps")->excludes(steps);
    train->add_option("--seed", options.seed, "seed of the initial weights, batches and augmentation (default 1)");
    train->add_option("--split-seed", options.splitSeed, "seed of the 8:1:1 split (default 1)");
    train->add_option("--hold-out", call->heldOut, "fabrics to leave out, F03,F07")->delimiter(',');
    call->losses.offer(*train);
    train
        ->add_option("--split", options.split,
                     "units of the 8:1:1 split: location (default), sample, augmented (as in the paper, with its leak)")
        ->transform(CLI::CheckedTransformer(std::map<std::string, models::SplitBy>{{"location", models::SplitBy::Location},
                                                                                   {"sample", models::SplitBy::Sample},
                                                                                   {"augmented", models::SplitBy::Augmented}}));
    train->add_flag("--resume", options.resume, "continue from the last checkpoint of an interrupted run");
    train->add_option("--batch", options.batch, "photographs per step (default 8)");
    train->add_option("--crop", options.crop, "side of a crop in px (default 128)");
    train->add_option("--channels", options.baseChannels, "width of the networks (default 16)");
    train->add_option("--learning-rate", options.learningRate, "initial learning rate of the generators (default 0.001)");
    train->add_option("--checkpoint-every", options.checkpointEvery, "steps (default 100)");
    train->add_option("--validate-every", options.validateEvery, "steps (default 250)");
    train->add_option("--patience", options.patience,
                      "number of validations without a better one after which training stops (default 12)");
    train->add_option("--stop-at", options.stopAt, "step to stop at, though the learning rate falls over all --steps");
    train->add_option("--validation-pairs", options.validationPairs, "number of pairs for the validation figures (default 60)");
    train->add_option("--threads", options.threads, "default: all threads of the machine");
    train->callback([call, steps, minutes, command] {
        models::TrainingOptions& chosen = call->options;
        if (minutes->count() > 0)
            chosen.minutes = call->minutes;
        else
            chosen.steps = steps->count() > 0 ? call->steps : 5000;
        for (const std::string& id : call->heldOut) chosen.heldOut.emplace_back(id);
        chosen.objective = call->losses.chosen();
        chosen.command = command;
        models::train(fabrics::readDataset(call->dataset), chosen, std::cout, isatty(STDOUT_FILENO) == 1);
    });
}

/// Trained networks need smaller steps than new ones.
constexpr double rateFromModel = 5e-4;
/// A few photographs need still smaller ones, and more frequent checkpoints.
constexpr double rateForLab = 3e-4;
constexpr int labCheckpointEvery = 50;
constexpr double labMinutes = 10;

void offerClothTraining(CLI::App& app, const std::string& command)
{
    struct ClothCall {
        models::ClothTrainingOptions options;
        std::string lab, scans;
        std::vector<std::string> heldOut;
        int steps = 0;
        double minutes = 0;
        ObjectiveFlags losses;
    };
    auto call = std::make_shared<ClothCall>();
    CLI::App* train = app.add_subcommand("train-cloth", "train the networks that see on drawn fabrics and on scans");
    models::ClothTrainingOptions& options = call->options;
    train->add_option("--out", options.out, "weights file; its model card is written to MODEL.json")->required();
    train->add_option("--from", options.from, "model of such a training to start from");
    train->add_option("--towards", options.towards, "no training: write weights on the way from the model of --from to this one");
    train->add_option("--way", options.way, "with --towards: share of the way (default 0.5)")->needs("--towards");
    train->add_option("--lab", call->lab, "a lab's own data set, to which the model of --from is adapted");
    train->add_option("--split-seed", options.splitSeed, "with --lab: seed of the held-out places and fabrics (default 1)");
    train->add_option("--scans", call->scans, "data set of `vis2hap import scans`");
    CLI::Option* steps =
        train->add_option("--steps", call->steps, "optimisation steps (default 15000; with --lab 10 minutes instead)");
    CLI::Option* minutes = train->add_option("--minutes", call->minutes, "wall time instead of steps")->excludes(steps);
    train->add_option("--seed", options.seed, "seed of the first weights and of the drawn fabrics (default 1)");
    train->add_option("--hold-out", call->heldOut, "scans to leave out, F03,F07")->delimiter(',');
    call->losses.offer(*train);
    train->add_flag("--resume", options.resume, "continue from the last checkpoint of an interrupted run");
    train->add_option("--batch", options.batch, "patches per step (default 8)");
    train->add_option("--crop", options.side, "side of a patch in px (default 128)");
    train->add_option("--channels", options.baseChannels, "width of the relief network (default 24)");
    train->add_option("--scan-share", options.scanShare, "share of scanned cloth in a batch (default 0.3)");
    CLI::Option* rate = train->add_option("--learning-rate", options.learningRate,
                                          "initial learning rate (default 0.002; with --from 0.0005, with --lab 0.0003)");
    CLI::Option* checkpoints =
        train->add_option("--checkpoint-every", options.checkpointEvery, "steps (default 500; with --lab 50)");
    train->add_option("--validate-every", options.validateEvery, "steps (default 1000)");
    train->add_option("--validation-patches", options.validationPatches, "drawn patches for the validation figures (default 96)");
    train->add_option("--threads", options.threads, "default: all threads of the machine");
    train->add_option("--processes", options.place.processes, "number of processes that train together (default 1)");
    train->add_option("--rank", options.place.rank, "number of this process, from 0; rank 0 writes the model (default 0)");
    train->add_option("--master", options.place.master, "HOST:PORT at which rank 0 waits for the others");
    train->add_option("--wait", options.place.waitS, "longest wait for the other processes, s (default 600)");
    train->callback([call, steps, minutes, rate, checkpoints, command] {
        models::ClothTrainingOptions& chosen = call->options;
        const bool ofLab = !call->lab.empty();
        if (minutes->count() > 0)
            chosen.minutes = call->minutes;
        else if (ofLab && steps->count() == 0)
            chosen.minutes = labMinutes;
        else
            chosen.steps = steps->count() > 0 ? call->steps : 15000;
        for (const std::string& id : call->heldOut) chosen.heldOut.emplace_back(id);
        chosen.makeObjective = models::paperObjective(call->losses.chosen());
        if (!chosen.from.empty() && rate->count() == 0) chosen.learningRate = ofLab ? rateForLab : rateFromModel;
        if (ofLab && checkpoints->count() == 0) chosen.checkpointEvery = labCheckpointEvery;
        chosen.command = command;
        const auto scans = call->scans.empty() ? std::nullopt : std::optional(fabrics::readDataset(call->scans));
        if (ofLab) {
            if (!chosen.place.isAlone())
                throw protocols::badInput({"--processes was given together with DATASET", "train",
                                           "one process, or a training with --drawn", "leave --processes out"});
            if (chosen.from.empty())
                throw protocols::badInput(
                    {"--lab was given without --from", "train-cloth", "a model to adapt", "name it with --from"});
            models::adaptToLab(fabrics::readDataset(call->lab), scans ? &*scans : nullptr, chosen, std::cout,
                               isatty(STDOUT_FILENO) == 1);
            return;
        }
        models::trainOnCloth(scans ? &*scans : nullptr, chosen, std::cout, isatty(STDOUT_FILENO) == 1);
    });
}

void offerGeneration(CLI::App& app)
{
    auto folder = std::make_shared<std::string>();
    CLI::App* generate = app.add_subcommand("generate", "answer the request in a folder (see exchange.h)");
    generate->add_option("FOLDER", *folder, "folder with request.json; receives answer.json")->required();
    generate->callback([folder] {
        const models::GenerationRequest request = models::readRequest(*folder);
        const models::LoadedModel model(request.options.model);
        models::AnswerWriter answers(*folder);
        for (const models::RequestedPhotograph& photograph : request.photographs)
            answers.add(model.generate(models::readPhotograph(photograph), request.options));
        answers.finish();
    });
}

void offerBench(CLI::App& app)
{
    struct GeneratorBenchCall {
        std::string dataset, model, json;
    };
    auto call = std::make_shared<GeneratorBenchCall>();
    CLI::App* bench = app.add_subcommand("bench", "speed and error of every quality");
    bench->add_option("DATASET", call->dataset, "default: a small procedural set");
    bench->add_option("--model", call->model, "default: the weights of the program");
    CLI::Option* json = bench->add_option("--json", call->json, "JSON output to FILE or to standard output")->expected(0, 1);
    bench->callback([call, json] {
        const models::BenchTable table = models::benchGenerators(call->model, call->dataset);
        if (json->count() == 0)
            std::cout << models::asText(table);
        else if (call->json.empty())
            std::cout << models::asJson(table);
        else
            models::writeBench(call->json, table);
    });
}

void offerPeerSteps(CLI::App& app)
{
    auto folder = std::make_shared<std::string>();
    CLI::App* steps = app.add_subcommand(
        "peer-steps", "run training steps and inference that are timed in turns with others (see peer_step.h)");
    steps->add_option("FOLDER", *folder, "folder that receives peer.safetensors")->required();
    steps->callback([folder] { models::servePeerSteps(*folder, std::cin, std::cout); });
}

/// Command line for the model card, without --resume, because a resumed run gives the same result as an uninterrupted one.
std::string commandLine(int argc, char** argv)
{
    std::vector<std::string> words(argv + 1, argv + argc);
    std::erase(words, "--resume");
    // `vis2hap train` calls this program with train-cloth; the card names what the user types.
    const auto cloth = std::find(words.begin(), words.end(), "train-cloth"), lab = std::find(words.begin(), words.end(), "--lab");
    if (cloth != words.end()) {
        *cloth = lab == words.end() ? "train --drawn" : "train";
        if (lab != words.end()) words.erase(lab);
    }
    std::string command = "vis2hap";
    for (const std::string& word : words) command += " " + word;
    return command;
}

int failed(const std::string& what, protocols::ExitCode code)
{
    std::cerr << "vis2hap: " << what.substr(0, what.find('\n')) << std::endl;
    return static_cast<int>(code);
}

/// True for the errors of torch and OpenCV where memory cannot be had; neither has a type of its own.
bool namesMissingMemory(const std::string& what)
{
    for (const char* text : {"can't allocate memory", "not enough memory", "Insufficient memory", "Failed to allocate"})
        if (what.find(text) != std::string::npos) return true;
    return false;
}

int failedForMemory()
{
    struct rlimit most {};
    std::string where;
    if (::getrlimit(RLIMIT_DATA, &most) == 0 && most.rlim_cur != RLIM_INFINITY)
        where = " (the limit is " + std::to_string(most.rlim_cur >> 20U) + " MB; VIS2HAP_NN_MEMORY_MB sets another)";
    return failed("the memory is too small" + where + ": close other programs or use fewer or smaller pictures",
                  protocols::ExitCode::Environment);
}

/// Sets missing thread settings and starts this program again, once. The libraries have already read the environment when
/// main() begins.
void setUpThreads(int argc, char** argv)
{
    auto missing = models::missingThreadSettings();
    // Torch would write lines of its own about connections beside the one error.
    const bool hasPeers = std::find(argv + 1, argv + argc, std::string_view("--processes")) != argv + argc;
    if (hasPeers && std::getenv("GLOG_minloglevel") == nullptr) missing.emplace_back("GLOG_minloglevel", "3");
    if (missing.empty()) return;
    for (const auto& [name, value] : missing) ::setenv(name.c_str(), value.c_str(), 1);
    std::error_code none;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", none);
    if (!none) ::execv(self.c_str(), argv);
}

int run(int argc, char** argv)
{
    CLI::App app("Generators of height maps and friction spectrograms from photographs", "vis2hap");
    app.require_subcommand(1);
    offerTraining(app, commandLine(argc, argv));
    offerClothTraining(app, commandLine(argc, argv));
    offerGeneration(app);
    offerBench(app);
    offerPeerSteps(app);
    try {
        protocols::requirePlainWholeNumbers(app);
        app.parse(argc, argv);
    } catch (const CLI::ParseError& fault) {
        if (fault.get_exit_code() == 0) return app.exit(fault);
        return failed(fault.what(), protocols::ExitCode::BadInput);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    using protocols::ExitCode;
    std::signal(SIGCHLD, SIG_DFL);  // a parent that ignores it would hide the ends of other programs
    setUpThreads(argc, argv);
    protocols::keepFreedMemory();
    try {
        return run(argc, argv);
    } catch (const protocols::Error& fault) {
        return failed(fault.what(), fault.exitCode());
    } catch (const std::bad_alloc&) {
        return failedForMemory();
    } catch (const std::filesystem::filesystem_error& fault) {
        return failed(fault.what(), ExitCode::Environment);
    } catch (const std::exception& fault) {
        return namesMissingMemory(fault.what()) ? failedForMemory() : failed(fault.what(), ExitCode::WorkFailed);
    }
}
