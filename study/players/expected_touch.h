// What a participant who knows the display expects a real fabric to feel like on it (the assumption is
// told in simulated_participant.h).
#pragma once

#include <filesystem>
#include <map>

#include "database/study_store.h"
#include "study/players/percept.h"

namespace study::players {

/// Friction x relief of each of the study's fabrics from its own presses and strokes, felt at up to
/// four places spread over the data set's samples and averaged. Warns on standard error where the data
/// set is not the one of the study. Throws badInput where it has no tactile or friction signal.
std::map<protocols::FabricId, Percept> expectedTouch(const database::StudyFacts& facts, const std::filesystem::path& dataset);

}  // namespace study::players
