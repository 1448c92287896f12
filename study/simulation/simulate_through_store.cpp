#include "study/simulation/simulate_through_store.h"

#include <algorithm>

#include "rendering/display/display.h"
#include "study/session/driver.h"

namespace study::simulation {

namespace {

// Each page of the database that several participants change is then written once. A killed simulation loses no more than these.
constexpr std::size_t participantsAtOnce = 64;

void playOne(database::StudyStore& store, rendering::StimulusBank& bank, const players::Percepts& percepts,
             const protocols::ParticipantId& participant, const StoreSimulation& simulation)
{
    const auto display = rendering::openDisplay("none");
    session::VirtualClock clock;
    session::Driver driver(store, participant, database::ParticipantKind::Simulated, bank, *display, clock,
                           simulation.operatedBy);
    players::DriverHands hands(driver);
    players::SimulatedParticipant usual(percepts, simulation.seed, participant.value);
    const auto judge = simulation.judge ? simulation.judge(participant) : judgeOf(usual);
    players::Mishaps mishaps(simulation.mishaps, simulation.seed, participant, driver.plan().protocol.answersPerParticipant());
    playSession(judge, mishaps, driver.plan(), hands, clock);
}

}  // namespace

void simulateThroughStore(database::StudyStore& store, rendering::StimulusBank& bank, const players::Percepts& percepts,
                          const std::vector<protocols::ParticipantId>& participants, const StoreSimulation& simulation,
                          const std::function<void(std::size_t done)>& progress)
{
    for (std::size_t done = 0; done < participants.size();) {
        database::StudyStore::Batch batch(store);
        for (const std::size_t end = std::min(done + participantsAtOnce, participants.size()); done < end; ++done)
            playOne(store, bank, percepts, participants[done], simulation);
        batch.commit();
        if (progress) progress(done);
    }
}

}  // namespace study::simulation
