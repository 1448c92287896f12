// vis2hap simulate STUDY: simulated participants feel the friction images and answer through the same session engine
// as human participants.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "database/keys.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "rendering/display/display.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/progress.h"
#include "study/players/expected_touch.h"
#include "study/players/simulated_participant.h"
#include "study/records/stored_study.h"
#include "study/session/stimuli.h"

namespace study::commands {

namespace {

using database::ParticipantKind;
using database::SlotState;
using database::StudyStore;

struct SimulateCall {
    std::string study, dataset;
    std::optional<int> participants;
    std::uint64_t seed = 1;
    PassphraseOption passphrase;
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
                                   store.folder().folder.string(), "--participants " + std::to_string(free) + " or fewer",
                                   "make a study with more participants"});
    const auto fresh = store.nextParticipantIds("SIM", static_cast<std::size_t>(std::max(0, wanted.value_or(free))));
    participants.insert(participants.end(), fresh.begin(), fresh.end());
    return participants;
}

int simulate(const SimulateCall& call)
{
    StudyStore store({call.study}, StudyStore::Access::Write);
    const auto facts = store.facts();
    const auto protocol = records::protocolOf(facts);
    const auto participants = participantsToPlay(store, call.participants);
    const auto key = readAllocationKeyForTestDriver(store, ParticipantKind::Simulated, passphraseFrom(call.passphrase));
    auto bank = session::stimuliOf(store);

    players::Percepts percepts;
    percepts.stationKey = stationKeyOf(key.secret);
    percepts.fabrics = players::expectedTouch(facts, call.dataset.empty() ? facts.datasetPath : call.dataset);
    for (const auto& [code, entry] : key.entries) percepts.stimuli[code] = players::feel(bank.imageOf(code));

    const auto display = rendering::openDisplay("none");
    Progress progress("simulated participants");
    int played = 0;
    for (const auto& id : participants) {
        session::VirtualClock clock;
        session::Driver driver(store, id, ParticipantKind::Simulated, bank, *display, clock,
                               session::operatedBy({}, versionText()));
        players::DriverHands hands(driver);
        players::SimulatedParticipant participant(percepts, call.seed, id.value);
        players::playSimulated(participant, driver.plan(), hands, clock);
        progress.show(++played, static_cast<int>(participants.size()), id.value);
    }
    std::printf("%s: %d simulated participants answered\n", call.study.c_str(), played);
    std::printf("  log head %s\n", textOf(store.head()).c_str());
    return 0;
}

}  // namespace

void addSimulate(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("simulate", "let simulated participants answer in the free slots");
    auto call = std::make_shared<SimulateCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--participants", call->participants, "number of participants (default: all free slots)")
        ->check(CLI::Range(1, 10000));
    command->add_option("--seed", call->seed, "seed of the participants and their noise")->capture_default_str();
    command->add_option("--dataset", call->dataset, "folder of the data set, if it was moved");
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return simulate(*call); };
    });
}

}  // namespace study::commands
