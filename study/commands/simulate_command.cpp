// vis2hap simulate STUDY [--in-memory --out DIR] [--mishaps] [--plant FILE]: simulated participants feel the friction images and
// answer through the same session engine as human participants, into the study or in memory. With --shard a part of those in
// memory.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "database/keys.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/composition/display_mapping.h"
#include "rendering/response/response_file.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/progress.h"
#include "study/commands/parts/shard_option.h"
#include "study/commands/passphrase_option.h"
#include "study/players/expected_touch.h"
#include "study/players/planted_effects.h"
#include "study/players/player_answers.h"
#include "study/records/display_response_record.h"
#include "study/records/stored_study.h"
#include "study/session/stimuli.h"
#include "study/simulation/simulate_through_store.h"
#include "study/simulation/simulation_analysis.h"
#include "study/simulation/simulation_files.h"
#include "study/simulation/simulation_shard.h"

namespace study::commands {

namespace {

using database::ParticipantKind;
using database::SlotState;
using database::StudyStore;

struct SimulateCall {
    std::string study, dataset, out, plant;
    bool inMemory = false, mishaps = false;
    std::optional<int> participants;
    std::uint64_t seed = 1;
    PassphraseOption passphrase;
    ShardOption shard;
};

/// The participants of started sessions, then new ones for `wanted` free slots, or for all free slots.
std::vector<protocols::ParticipantId> participantsToPlay(const StudyStore& store, std::optional<int> wanted)
{
    std::vector<protocols::ParticipantId> participants;
    int free = 0;
    for (const auto& slot : store.slots()) {
        free += slot.state == SlotState::Free;
        if (slot.state == SlotState::Free || slot.kind != ParticipantKind::Simulated) continue;
        if (slot.state == SlotState::Started) participants.push_back(slot.participant);
    }
    if (wanted && *wanted > free)
        throw protocols::badInput({"the study has only " + reports::counted(static_cast<std::size_t>(free), "free slot"),
                                   store.folder().folder.string(),
                                   free == 0 ? "a study with free slots" : "--participants " + std::to_string(free) + " or fewer",
                                   "make a study with more participants"});
    const auto fresh = store.nextParticipantIds("SIM", static_cast<std::size_t>(std::max(0, wanted.value_or(free))));
    participants.insert(participants.end(), fresh.begin(), fresh.end());
    return participants;
}

/// The response through which the study's images are mapped, if there is one.
std::optional<rendering::DisplayResponse> displayResponseOf(const database::StudyFacts& facts)
{
    const auto made = protocols::storedOrderedJson(facts.madeWith);
    if (!made.is_object() || !made.contains(records::displayResponseField)) return std::nullopt;
    return rendering::responseFromJson(made.at(records::displayResponseField).dump(),
                                       "the study's " + std::string(records::displayResponseField));
}

/// What the study's images feel like, and what a participant expects of its fabrics.
players::Percepts perceptsOf(const StudyStore& store, const protocols::AllocationKey& key, rendering::StimulusBank& bank,
                             const std::string& dataset)
{
    const auto& facts = store.facts();
    players::Percepts percepts;
    percepts.stationKey = stationKeyOf(key.secret);
    percepts.fabrics = players::expectedTouch(facts, dataset.empty() ? facts.datasetPath : dataset);
    const auto response = displayResponseOf(facts);
    for (const auto& [code, entry] : key.entries) {
        const cv::Mat image = bank.imageOf(code);
        percepts.stimuli[code] = players::feel(response ? frictionOnDisplay(image, *response) : image);
    }
    return percepts;
}

players::MishapRates mishapsOf(const SimulateCall& call) { return call.mishaps ? players::usualMishaps : players::MishapRates{}; }

/// The effects of --plant FILE; empty without it.
struct Planting {
    players::PlantedEffects effects;
    std::string sha256;
};

Planting plantingOf(const SimulateCall& call, const StudyStore& store, const std::vector<protocols::ParticipantId>& toPlay)
{
    Planting planting;
    if (call.plant.empty()) return planting;
    const std::string text = protocols::readWholeFile(call.plant, protocols::largestJson);
    planting.effects = players::plantedEffectsFromJson(text, call.plant, records::protocolOf(store.facts()));
    planting.sha256 = protocols::sha256(text);
    std::set<protocols::ParticipantId> known(toPlay.begin(), toPlay.end());
    for (const auto& enrolment : store.enrolments()) known.insert(enrolment.participant);
    for (const auto& careless : planting.effects.careless)
        if (!known.contains(careless))
            throw protocols::badInput(
                {"the careless participant " + careless.value + " takes no part", call.plant,
                 toPlay.empty() ? "a participant of the study" : toPlay.front().value + " to " + toPlay.back().value,
                 "correct \"careless\""});
    return planting;
}

/// Names the planted effects beside the program, so that the log of each sitting holds them.
std::string playedBy(const Planting& planting)
{
    return versionText() + (planting.sha256.empty() ? "" : ", planted effects of SHA-256 " + planting.sha256.substr(0, 16));
}

int simulateIntoStudy(const SimulateCall& call)
{
    StudyStore store({call.study}, StudyStore::Access::Write);
    const auto participants = participantsToPlay(store, call.participants);
    const Planting planting = plantingOf(call, store, participants);
    const auto key = readAllocationKeyForTestDriver(store, ParticipantKind::Simulated, passphraseFrom(call.passphrase));
    auto bank = session::stimuliOf(store);
    const auto percepts = perceptsOf(store, key, bank, call.dataset);
    simulation::StoreSimulation simulation{call.seed, mishapsOf(call), session::operatedBy({}, playedBy(planting))};
    if (!call.plant.empty())
        simulation.judge = [&](const protocols::ParticipantId& participant) {
            auto usual = std::make_shared<players::SimulatedParticipant>(percepts, call.seed, participant.value);
            return plantedJudge(
                planting.effects, [&key](const protocols::BlindedTrial& trial) -> const auto& { return key.entryOf(trial); },
                participant, call.seed,
                [usual](const auto& trial, const auto& question) { return players::simulatedAnswer(*usual, trial, question); });
        };
    {
        Progress progress("simulated participants");
        simulation::simulateThroughStore(store, bank, percepts, participants, simulation, [&](std::size_t done) {
            progress.show(static_cast<int>(done), static_cast<int>(participants.size()), participants[done - 1].value);
        });
    }
    std::printf("%s: %zu simulated participants answered%s\n", protocols::printable(call.study).c_str(), participants.size(),
                call.plant.empty() ? "" : (" with the planted effects of " + call.plant).c_str());
    std::printf("  log head %s\n", protocols::printable(textOf(store.head())).c_str());
    return 0;
}

/// "10,000 simulated participants ..., 2,520,000 valid answers"
void sayWhatWasSimulated(const std::string& study, bool hasMishaps, const std::string& out,
                         const reports::StudyAnalysis& analysis, const std::vector<simulation::SimulatedAnswers>& answers)
{
    std::size_t corrections = 0, refusals = 0;
    for (const auto& one : answers) {
        corrections += static_cast<std::size_t>(one.corrections);
        refusals += static_cast<std::size_t>(one.refusals);
    }
    const auto& data = analysis.data;
    std::printf("%s: %zu simulated participants in memory, %zu valid answers; nothing was stored in the study\n",
                protocols::printable(study).c_str(), answers.size(), analysis.completeness.present);
    if (hasMishaps)
        std::printf("  mishaps: %zu withdrawals, %zu voided presentations, %zu corrections, %zu refused steps\n",
                    data.withdrawn.size(), data.voided, corrections, refusals);
    std::printf("  %s holds results.json and tables; mixed models and what rests on them are left out\n",
                protocols::printable(out).c_str());
}

constexpr const char* simulateName = "simulate";

int simulateOnlyInMemory(const SimulateCall& call)
{
    const bool isShard = call.shard.isGiven();
    if (isShard && !call.out.empty())
        throw protocols::badInput({"--out was given together with --shard", simulateName, "a shard's own file, by --shard-file",
                                   "leave --out out, and give it to `vis2hap merge`"});
    const stats::Share share = shareOf(call.shard, simulateName, {});
    if (!isShard && call.out.empty())
        throw protocols::badInput({"a simulation in memory needs a place for its tables", "--in-memory", "--out DIR", "add it"});
    if (!isShard) simulation::requireReplaceableSimulation(call.out);
    const StudyStore store({call.study}, StudyStore::Access::Read);
    const auto key = readAllocationKeyForTestDriver(store, ParticipantKind::Simulated, passphraseFrom(call.passphrase));
    auto bank = session::stimuliOf(store);
    const auto study = simulation::memoryStudyOf(store, key, perceptsOf(store, key, bank, call.dataset));
    simulation::SimulationRequest request{.seed = call.seed, .mishaps = mishapsOf(call)};
    request.count = call.participants.value_or(static_cast<int>(study.places.size()));
    const simulation::SimulationRequest own = simulation::shareOf(request, share);
    std::vector<simulation::SimulatedAnswers> answers;
    {
        Progress progress("simulated participants");
        answers = simulateInMemory(study, own, [&](std::size_t done) { progress.show(static_cast<int>(done), own.count); });
    }
    if (isShard) {
        writeShard(call.shard, simulateName, sharedOptions(store, request, call.mishaps),
                   {{"study_folder", call.study}, {"answers", answersJson(answers)}});
        return 0;
    }
    const auto analysis = analysisOf(study, answers);
    simulation::writeSimulation(analysis, store.facts().madeWith, call.out);
    sayWhatWasSimulated(call.study, call.mishaps, call.out, analysis, answers);
    return 0;
}

int simulate(const SimulateCall& call)
{
    if (call.inMemory && !call.plant.empty())
        throw protocols::badInput({"--plant was given together with --in-memory", "--plant " + call.plant,
                                   "a simulation into the study", "leave one of them out"});
    if (call.inMemory) return simulateOnlyInMemory(call);
    if (call.shard.isGiven())
        throw protocols::badInput({"--shard belongs to a simulation in memory", "--shard " + call.shard.number,
                                   "--in-memory: one study takes the answers of one process", "add --in-memory"});
    if (!call.out.empty())
        throw protocols::badInput({"--out belongs to a simulation in memory", "--out " + call.out,
                                   "--in-memory, or no --out: the answers go into the study",
                                   "add --in-memory, or run `vis2hap report` after the simulation"});
    return simulateIntoStudy(call);
}

}  // namespace

void mergeSimulate(const shards::ShardedRun& run, const MergeOutput& output)
{
    if (output.json || output.out.empty())
        throw protocols::badInput({"a simulation in memory needs a place for its tables", "merge", "--out DIR, without --json",
                                   "name a folder with --out"});
    simulation::requireReplaceableSimulation(output.out);
    const auto shared = simulation::sharedSimulationFrom(run.options(), run.files.front().string());
    simulation::SimulationRequest whole;
    whole.count = shared.participants;
    std::vector<simulation::SimulatedAnswers> answers;
    std::string folder;
    try {
        for (std::size_t i = 0; i < run.shards.size(); ++i) {
            const auto own = simulation::shareOf(whole, run.shards[i].share);
            for (auto& one :
                 simulation::answersFrom(run.shards[i].values.at("answers"), shared, own.first, own.count, run.files[i].string()))
                answers.push_back(std::move(one));
        }
        folder = run.shards.front().values.at("study_folder").get<std::string>();
    } catch (const nlohmann::ordered_json::exception&) {
        throw protocols::badInput({"the shards hold no answers", run.files.front().string(),
                                   "shards as `vis2hap simulate --in-memory` writes them", "run the shards again"});
    }
    const auto analysis = analysisOf(shared.study, answers);
    simulation::writeSimulation(analysis, shared.madeWith, output.out);
    sayWhatWasSimulated(folder, shared.hasMishaps, output.out, analysis, answers);
}

void addSimulate(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("simulate", "let simulated participants answer in the free slots");
    auto call = std::make_shared<SimulateCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--participants", call->participants, "number of participants (default: all free slots)")
        ->check(CLI::Range(1, 10'000'000));
    command->add_option("--seed", call->seed, "seed of the participants and their noise")->capture_default_str();
    command->add_option("--dataset", call->dataset, "folder of the data set, if it was moved");
    command->add_flag("--in-memory", call->inMemory,
                      "store nothing in the study: write tables into --out; any number of participants");
    command->add_option("--out", call->out, "folder for the results of --in-memory");
    command->add_flag("--mishaps", call->mishaps,
                      "let presentations be voided, answers corrected, steps refused, and participants withdraw");
    command->add_option("--plant", call->plant, "file with effects to plant and careless participants, for teaching");
    addShardOptions(*command, call->shard);
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return simulate(*call); };
    });
}

}  // namespace study::commands
