// vis2hap-nn: the second executable, the only one that loads libtorch. `vis2hap train` and the first
// generated signal start it; it can be called by hand too.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "protocols/files/errors.h"
#include "rendering/models/child_process.h"
#include "rendering/models/exchange.h"
#include "rendering/models/networks/inference.h"
#include "rendering/models/networks/nn_bench.h"
#include "rendering/models/networks/peer_step.h"
#include "rendering/models/networks/training.h"

namespace {

using namespace rendering;

void offerTraining(CLI::App& app, const std::string& command)
{
    struct Wish {
        std::string dataset;
        models::TrainingOptions options;
        std::vector<std::string> heldOut;
        int steps = 0;
        double minutes = 0;
        bool reference = false, l1Only = false;
    };
    auto wish = std::make_shared<Wish>();
    CLI::App* train = app.add_subcommand("train", "train the generators on a data set");
    models::TrainingOptions& options = wish->options;
    train->add_option("DATASET", wish->dataset, "folder with photographs, GelSight frames and friction records")->required();
    train->add_option("--out", options.out, "weights file; its model card is written to MODEL.json")->required();
    CLI::Option* steps = train->add_option("--steps", wish->steps, "optimisation steps (default 5000)");
    CLI::Option* minutes = train->add_option("--minutes", wish->minutes, "wall time instead of steps")->excludes(steps);
    train->add_option("--seed", options.seed, "of the first weights, batches and augmentation (default 1)");
    train->add_option("--split-seed", options.splitSeed, "of the 8:1:1 split (default 1)");
    train->add_option("--hold-out", wish->heldOut, "fabrics to leave out, F03,F07")->delimiter(',');
    train->add_flag("--reference", wish->reference, "the paper's losses to the letter");
    train->add_flag("--l1-only", wish->l1Only, "the paper's L1 loss alone, without a discriminator: a control for evaluate");
    train
        ->add_option("--split", options.split,
                     "what the 8:1:1 split divides: location (default), sample, augmented (the paper's, with its leak)")
        ->transform(CLI::CheckedTransformer(std::map<std::string, models::SplitBy>{{"location", models::SplitBy::Location},
                                                                                   {"sample", models::SplitBy::Sample},
                                                                                   {"augmented", models::SplitBy::Augmented}}));
    train->add_flag("--resume", options.resume, "go on from the last checkpoint of a broken-off run");
    train->add_option("--batch", options.batch, "photographs a step (default 8)");
    train->add_option("--crop", options.crop, "side of a crop, px (default 128)");
    train->add_option("--channels", options.baseChannels, "width of the networks (default 16)");
    train->add_option("--learning-rate", options.learningRate, "of the generators at the start (default 0.001)");
    train->add_option("--checkpoint-every", options.checkpointEvery, "steps (default 100)");
    train->add_option("--validate-every", options.validateEvery, "steps (default 250)");
    train->add_option("--patience", options.patience,
                      "validations without a better one, after which training stops (default 12)");
    train->add_option("--validation-pairs", options.validationPairs, "pairs that the validation figures rest on (default 60)");
    train->add_option("--threads", options.threads, "default: all of the machine");
    train->callback([wish, steps, minutes, command] {
        models::TrainingOptions& chosen = wish->options;
        if (minutes->count() > 0)
            chosen.minutes = wish->minutes;
        else
            chosen.steps = steps->count() > 0 ? wish->steps : 5000;
        for (const std::string& id : wish->heldOut) chosen.heldOut.emplace_back(id);
        if (wish->reference && wish->l1Only)
            throw protocols::badInput({"both --reference and --l1-only", "train", "one of them", ""});
        chosen.objective = wish->reference ? models::Objective::Reference
                           : wish->l1Only  ? models::Objective::L1Only
                                           : models::Objective::Default;
        chosen.command = command;
        models::train(fabrics::readDataset(wish->dataset), chosen, std::cout, isatty(STDOUT_FILENO) == 1);
    });
}

void offerGeneration(CLI::App& app)
{
    auto folder = std::make_shared<std::string>();
    CLI::App* generate = app.add_subcommand("generate", "answer a request folder (see exchange.h)");
    generate->add_option("FOLDER", *folder, "holds request.json; answer.json is written into it")->required();
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
    struct Wish {
        std::string dataset, model, json;
    };
    auto wish = std::make_shared<Wish>();
    CLI::App* bench = app.add_subcommand("bench", "speed and error of every quality");
    bench->add_option("DATASET", wish->dataset, "default: a small procedural set");
    bench->add_option("--model", wish->model, "default: the shipped weights");
    CLI::Option* json = bench->add_option("--json", wish->json, "as JSON, into FILE or to standard output")->expected(0, 1);
    bench->callback([wish, json] {
        const models::BenchTable table = models::benchGenerators(wish->model, wish->dataset);
        if (json->count() == 0)
            std::cout << models::asText(table);
        else if (wish->json.empty())
            std::cout << models::asJson(table);
        else
            models::writeBench(wish->json, table);
    });
}

void offerPeerSteps(CLI::App& app)
{
    auto folder = std::make_shared<std::string>();
    CLI::App* steps =
        app.add_subcommand("peer-steps", "training steps and inference to be timed in turns with others (see peer_step.h)");
    steps->add_option("FOLDER", *folder, "peer.pt is written into it")->required();
    steps->callback([folder] { models::servePeerSteps(*folder, std::cin, std::cout); });
}

/// As the model card tells it: without --resume, since a resumed run gives what an unbroken one gives.
std::string commandLine(int argc, char** argv)
{
    std::string command = "vis2hap";
    for (int i = 1; i < argc; ++i)
        if (std::string_view(argv[i]) != "--resume") command += std::string(" ") + argv[i];
    return command;
}

int failed(const std::string& what, protocols::ExitCode code)
{
    std::cerr << "vis2hap: " << what.substr(0, what.find('\n')) << std::endl;
    return static_cast<int>(code);
}

/// The libraries have read their environment when main() begins, so where something is missing this program starts itself
/// anew, once.
void setUpThreads(char** argv)
{
    const auto missing = models::missingThreadSettings();
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
    offerGeneration(app);
    offerBench(app);
    offerPeerSteps(app);
    try {
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
    setUpThreads(argv);
    try {
        return run(argc, argv);
    } catch (const protocols::Error& fault) {
        return failed(fault.what(), fault.exitCode());
    } catch (const std::bad_alloc&) {
        return failed("the memory does not suffice; close other programs or use fewer or smaller pictures",
                      ExitCode::Environment);
    } catch (const std::filesystem::filesystem_error& fault) {
        return failed(fault.what(), ExitCode::Environment);
    } catch (const std::exception& fault) {
        return failed(fault.what(), ExitCode::WorkFailed);
    }
}
