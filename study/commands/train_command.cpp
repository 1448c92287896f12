// vis2hap train DATASET --out MODEL ...: the second program does the work; the options are its own.
#include "study/commands/command_line.h"
#include "study/commands/second_program.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace study::commands {

void addTrain(CLI::App& app, Action& action)
{
    struct Call {
        std::string dataset, out, steps, minutes, seed, holdOut;
        bool reference = false, resume = false;
    };
    auto call = std::make_shared<Call>();
    auto* command = app.add_subcommand("train", "train the generators on a data set (uses libtorch)");
    command->add_option("DATASET", call->dataset, "the data set")->required();
    command->add_option("--out", call->out, "weights file to write")->required();
    auto* steps = command->add_option("--steps", call->steps, "training steps; the same number gives the same weights");
    command->add_option("--minutes", call->minutes, "stop after so many minutes instead")->excludes(steps);
    command->add_option("--seed", call->seed, "seed of the split, the weights and the batches");
    command->add_option("--hold-out", call->holdOut, "fabrics never trained on, e.g. F02,F09");
    command->add_flag("--reference", call->reference, "the paper's losses to the letter");
    command->add_flag("--resume", call->resume, "go on from the last checkpoint");
    command->callback([call, &action] {
        std::vector<std::string> arguments{"train", call->dataset, "--out", call->out};
        const auto pass = [&](const char* name, const std::string& value) {
            if (!value.empty())
                arguments.insert(arguments.end(), {name, value});
        };
        pass("--steps", call->steps);
        pass("--minutes", call->minutes);
        pass("--seed", call->seed);
        pass("--hold-out", call->holdOut);
        if (call->reference)
            arguments.push_back("--reference");
        if (call->resume)
            arguments.push_back("--resume");
        action.work = [arguments] { return runSecondProgram(arguments); };
    });
}

}  // namespace study::commands
