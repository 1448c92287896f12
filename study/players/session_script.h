// Recorded sessions as scripts (schema vis2hap.script/1) that replay to the same rows.
#pragma once

#include <filesystem>

#include "study/records/stored_study.h"

namespace study::players {

/// Writes one file for each participant. Answers are identified by rendering, or by trial where `naming` is null. Facts,
/// debriefing and the times of the preparation are left out. Erased participants have no script.
void writeScripts(const database::StudyStore& store, const records::Naming* naming, const std::filesystem::path& out);

}  // namespace study::players
