// vis2hap train DATASET --out MODEL ...: the second program does the work; the options are its own.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rendering/models/second_program.h"
#include "study/commands/command_line.h"

namespace study::commands {

namespace {

/// Options with a value, handed on as they are.
struct Wish {
    const char* name;
    const char* meaning;
    std::string value;
};

std::vector<Wish> wishes()
{
    return {{"--seed", "seed of the first weights, the batches and the augmentation (default 1)", ""},
            {"--hold-out", "fabrics never trained on, e.g. F02,F09", ""},
            {"--split", "what the 8:1:1 split divides: location (default), sample, augmented (the paper's, with its leak)", ""},
            {"--split-seed", "seed of the split (default 1)", ""},
            {"--threads", "default: all of the machine; another number changes the last bits of sums", ""},
            {"--batch", "photographs a step (default 8)", ""},
            {"--crop", "side of a training crop, px (default 128)", ""},
            {"--channels", "width of the networks (default 16)", ""},
            {"--learning-rate", "at the start (default 0.001)", ""},
            {"--checkpoint-every", "steps (default 100)", ""},
            {"--validate-every", "steps (default 250)", ""},
            {"--patience", "validations without a better one, after which training stops (default 12)", ""},
            {"--validation-pairs", "pairs that the validation figures rest on (default 60)", ""}};
}

}  // namespace

void addTrain(CLI::App& app, Action& action)
{
    struct Call {
        std::string dataset, out, steps, minutes;
        std::vector<Wish> wishes = commands::wishes();
        bool reference = false, l1Only = false, resume = false;
    };
    auto call = std::make_shared<Call>();
    auto* command = app.add_subcommand("train", "train the generators on a data set (uses libtorch)");
    command->add_option("DATASET", call->dataset, "the data set")->required();
    command->add_option("--out", call->out, "weights file to write; MODEL.json and the folder MODEL.log beside it")->required();
    auto* steps =
        command->add_option("--steps", call->steps, "training steps (default 5000); the same number gives the same weights");
    command->add_option("--minutes", call->minutes, "stop after so many minutes instead")->excludes(steps);
    for (Wish& wish : call->wishes) command->add_option(wish.name, wish.value, wish.meaning);
    auto* reference = command->add_flag("--reference", call->reference, "the paper's losses to the letter");
    command->add_flag("--l1-only", call->l1Only, "the paper's L1 loss alone: the control that evaluate compares with")
        ->excludes(reference);
    command->add_flag("--resume", call->resume, "go on from the last checkpoint");
    command->callback([call, &action] {
        std::vector<std::string> arguments{"train", call->dataset, "--out", call->out};
        const auto pass = [&](const char* name, const std::string& value) {
            if (!value.empty()) arguments.insert(arguments.end(), {name, value});
        };
        pass("--steps", call->steps);
        pass("--minutes", call->minutes);
        for (const Wish& wish : call->wishes) pass(wish.name, wish.value);
        for (const auto& [wanted, name] :
             {std::pair{call->reference, "--reference"}, {call->l1Only, "--l1-only"}, {call->resume, "--resume"}})
            if (wanted) arguments.emplace_back(name);
        action.work = [arguments] { return rendering::models::runSecondProgram(arguments); };
    });
}

}  // namespace study::commands
