// vis2hap fabrics make|check
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/drawn/drawn_dataset.h"
#include "rendering/fabrics/drawn/drawn_friction.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/models/drawn_memory.h"
#include "rendering/models/model_card_fields.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/progress.h"

namespace study::commands {

namespace {

struct MakeCall {
    std::string folder;
    rendering::fabrics::ProceduralOptions options;
    std::string pairing = "weak";
    std::optional<int> drawn, samples;
    rendering::fabrics::Pairing places() const
    {
        return pairing == "aligned" ? rendering::fabrics::Pairing::Aligned : rendering::fabrics::Pairing::Weak;
    }
};

/// Says where the weights that come with the program were trained on these very fabrics.
void noteOnMemory(const rendering::fabrics::Dataset& dataset)
{
    namespace models = rendering::models;
    if (!std::filesystem::exists(models::cardOf(models::shippedModel()))) return;
    const std::string note = models::noteOnDrawnFabrics(dataset, models::readModelCard(models::shippedModel()));
    if (!note.empty()) std::printf("note: %s\n", note.c_str());
}

int makeDrawn(const MakeCall& call)
{
    rendering::fabrics::DrawnOptions options;
    options.fabrics = *call.drawn;
    options.samples = call.samples.value_or(options.samples);
    options.seed = call.options.seed;
    options.pairing = call.places();
    Progress progress("fabrics");
    const auto dataset = makeDrawnFabrics(call.folder, options, [&](int done, int total) { progress.show(done, total); });
    std::printf("%s: %zu drawn fabrics with %d photographs, presses and strokes each; law of friction: %s\n",
                protocols::printable(call.folder).c_str(), dataset.fabrics.size(), options.samples,
                rendering::fabrics::frictionLaw().c_str());
    noteOnMemory(dataset);
    return 0;
}

int make(const MakeCall& call)
{
    if (call.drawn) return makeDrawn(call);
    auto options = call.options;
    options.samples = call.samples.value_or(options.samples);
    options.pairing = call.places();
    Progress progress("fabrics");
    const auto dataset = makeProceduralFabrics(call.folder, options, [&](int done, int total) { progress.show(done, total); });
    std::printf("%s: %zu procedural fabrics with %d photographs, presses and strokes each\n",
                protocols::printable(call.folder).c_str(), dataset.fabrics.size(), options.samples);
    return 0;
}

int checkDataset(const std::string& folder)
{
    Progress progress("samples");
    const auto [faults, notes] =
        rendering::fabrics::findingsOfDataset(folder, [&](int done, int total) { progress.show(done, total); });
    for (const auto& note : notes) std::printf("note: %s\n", protocols::printable(note).c_str());
    for (const auto& fault : faults) std::printf("%s\n", protocols::printable(fault).c_str());
    std::printf(
        "%s: %s\n", protocols::printable(folder).c_str(),
        faults.empty() ? "no faults" : (std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults")).c_str());
    return static_cast<int>(faults.empty() ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

}  // namespace

void addFabrics(CLI::App& app, Action& action)
{
    auto* fabrics = app.add_subcommand("fabrics", "make or check a fabric data set");
    fabrics->require_subcommand(1);

    auto* makeSet = fabrics->add_subcommand("make", "a data set of named or newly drawn fabrics");
    auto call = std::make_shared<MakeCall>();
    makeSet->add_option("DIR", call->folder, "folder to make")->required();
    auto* named = makeSet->add_option("--fabrics", call->options.fabrics, "number of the fifteen named fabrics")
                      ->check(CLI::Range(1, 15))
                      ->capture_default_str();
    makeSet->add_option("--drawn", call->drawn, "draw this number of new constructions instead (1 to 10000)")->excludes(named);
    makeSet->add_option("--samples", call->samples, "samples of each signal and fabric (default: 225; 3 with --drawn)")
        ->check(CLI::Range(1, 100000));
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
