// vis2hap fabrics make|check
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "study/commands/command_line.h"
#include "study/commands/progress.h"

namespace study::commands {

namespace {

struct MakeCall {
    std::string folder;
    rendering::fabrics::ProceduralOptions options;
    std::string pairing = "weak";
};

int make(const MakeCall& call)
{
    auto options = call.options;
    options.pairing = call.pairing == "aligned" ? rendering::fabrics::Pairing::Aligned : rendering::fabrics::Pairing::Weak;
    Progress progress("fabrics");
    const auto dataset = makeProceduralFabrics(call.folder, options, [&](int done, int total) { progress.show(done, total); });
    std::printf("%s: %zu procedural fabrics with %d photographs, presses and strokes each\n", call.folder.c_str(),
                dataset.fabrics.size(), options.samples);
    return 0;
}

int checkDataset(const std::string& folder)
{
    const auto faults = rendering::fabrics::faultsOfDataset(folder);
    for (const auto& fault : faults) std::printf("%s\n", fault.c_str());
    std::printf(
        "%s: %s\n", folder.c_str(),
        faults.empty() ? "no faults" : (std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults")).c_str());
    return static_cast<int>(faults.empty() ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

}  // namespace

void addFabrics(CLI::App& app, Action& action)
{
    auto* fabrics = app.add_subcommand("fabrics", "make or check a fabric data set");
    fabrics->require_subcommand(1);

    auto* makeSet = fabrics->add_subcommand("make", "a procedural fabric data set");
    auto call = std::make_shared<MakeCall>();
    makeSet->add_option("DIR", call->folder, "folder to make")->required();
    makeSet->add_option("--fabrics", call->options.fabrics, "number of fabrics")->check(CLI::Range(1, 15))->capture_default_str();
    makeSet->add_option("--samples", call->options.samples, "samples of each signal and fabric")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    makeSet->add_option("--seed", call->options.seed, "the same seed gives the same data set")->capture_default_str();
    makeSet
        ->add_option("--pairing", call->pairing,
                     "weak: photograph, press and stroke at different places; aligned: at the same place")
        ->check(CLI::IsMember({"weak", "aligned"}))
        ->capture_default_str();
    makeSet->callback([call, &action] { action.work = [call] { return make(*call); }; });

    auto* checkSet = fabrics->add_subcommand("check", "list every fault of a data set with its file");
    auto folder = std::make_shared<std::string>();
    checkSet->add_option("DIR", *folder, "the data set")->required();
    checkSet->callback([folder, &action] { action.work = [folder] { return checkDataset(*folder); }; });
}

}  // namespace study::commands
