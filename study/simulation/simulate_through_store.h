// Simulated participants in a study folder: the same driver and the same rows as for everybody, but a few whole participants
// share a transaction. A simulation that is killed leaves whole participants and a sound study, which the next one goes on with.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "rendering/display/stimulus_bank.h"
#include "study/session/operated_by.h"
#include "study/simulation/simulate_in_memory.h"

namespace study::simulation {

struct StoreSimulation {
    std::uint64_t seed = 1;
    players::MishapRates mishaps = {};
    session::OperatedBy operatedBy = {};
    MakeJudge judge = {};  ///< empty: the participants of simulated_participant.h
};

/// `store` must be open for writing. `participants`: new ones, or simulated ones whose sessions have begun. `progress` gets the
/// number of those that are stored.
void simulateThroughStore(database::StudyStore& store, rendering::StimulusBank& bank, const players::Percepts& percepts,
                          const std::vector<protocols::ParticipantId>& participants, const StoreSimulation& simulation,
                          const std::function<void(std::size_t done)>& progress = {});

}  // namespace study::simulation
