// The touch that a participant who knows the display expects of a real fabric. simulated_participant.h states the assumption.
#pragma once

#include <filesystem>
#include <map>

#include "database/study_store.h"
#include "study/players/percept.h"

namespace study::players {

/// Friction x relief of each of the study's fabrics from its own presses and strokes. It is the average over up to four places
/// that are spread over the data set's samples. Warns on standard error if the study was made from another data set. Throws
/// badInput for a data set without tactile or friction signal.
std::map<protocols::FabricId, Percept> expectedTouch(const database::StudyFacts& facts, const std::filesystem::path& dataset);

}  // namespace study::players
