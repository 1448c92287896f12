// A simulation in memory that is shared between processes: which participants are whose, and their answers as the values of a
// shard. Conditions lie open in them, as in every result of simulated participants; no code of a stimulus or a trial does.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/share.h"
#include "study/simulation/simulate_in_memory.h"

namespace study::simulation {

/// The share of this request: neighbouring participants, first and count.
SimulationRequest shareOf(const SimulationRequest& whole, const stats::Share& share);

/// What the results rest on besides the answers, so that merging needs no study folder. `whole`: the request of all participants.
nlohmann::ordered_json sharedOptions(const database::StudyStore& store, const SimulationRequest& whole, bool hasMishaps);

/// What sharedOptions() holds.
struct SharedSimulation {
    MemoryStudy study;  ///< name, protocol and fabrics; without places, images and percepts
    std::string madeWith;
    int participants = 0;
    bool hasMishaps = false;
};
/// Throws badInput, naming `where`, for other options than sharedOptions() gives.
SharedSimulation sharedSimulationFrom(const nlohmann::ordered_json& options, const std::string& where);

/// One object for each participant. Numbers are hexadecimal: little-endian, values of 2 bytes and times of 8; where some question
/// asks for same or different, 1 byte for each value says which pairs were the same.
nlohmann::ordered_json answersJson(const std::vector<SimulatedAnswers>& answers);

/// The answers of participants `first`, `first` + 1, ... Throws badInput, naming `where`, for other JSON than answersJson()
/// gives, other participants or other numbers of answers than the study has.
std::vector<SimulatedAnswers> answersFrom(const nlohmann::ordered_json& json, const SharedSimulation& simulation, int first,
                                          int count, const std::string& where);

}  // namespace study::simulation
