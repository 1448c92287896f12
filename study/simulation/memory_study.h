// A study as a simulation in memory needs it: the protocol, the running orders of its places, and what each image shows and feels
// like. The codes lie open in it, so it is made from the full key and never written to a file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "protocols/orders/allocation.h"
#include "study/players/simulated_participant.h"
#include "study/session/session.h"

namespace study::simulation {

struct MemoryStudy {
    std::string name;
    std::string protocolSha256;
    protocols::Protocol protocol;  ///< the latest version
    std::vector<protocols::FabricId> fabrics;
    session::PieceNames fabricNames;
    std::vector<protocols::SwatchLabels> swatches;             ///< [place]; empty: pieces have the names of the fabrics
    std::vector<std::vector<protocols::BlindedTrial>> places;  ///< [place]; sealedCode is the open file code
    std::map<protocols::FileCode, protocols::AllocationKey::Entry> images;
    players::Percepts percepts;  ///< with open codes
};

/// `percepts` has those of every image and fabric of the study. Throws workFailed where the key does not open a list.
MemoryStudy memoryStudyOf(const database::StudyStore& store, const protocols::AllocationKey& key, players::Percepts percepts);

/// The same without a study folder, for a bench. `fabrics`: in the order of the design's numbers.
MemoryStudy memoryStudyOf(const protocols::Protocol& protocol, const protocols::Allocation& allocation,
                          const std::vector<protocols::FabricId>& fabrics, players::Percepts percepts);

/// The list of a place, counted from 0. A place beyond those of the study belongs to a further set of all its orders, in which
/// conditions, fabrics and tray slots have changed places by a draw of their own. So each set is balanced as the study is.
/// Depends on `seed` and `place` alone.
std::vector<protocols::BlindedTrial> listOf(const MemoryStudy& study, std::size_t place, std::uint64_t seed);

/// The plan of a session without its list, which listOf() fills in.
session::Plan planWithoutList(const MemoryStudy& study);

/// The names of the pieces at a place.
session::PieceNames pieceNamesOf(const MemoryStudy& study, std::size_t place);

}  // namespace study::simulation
