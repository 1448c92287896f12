// Recorded sessions as scripts (schema vis2hap.script/1) that replay to the same rows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/records/stored_study.h"

namespace study::players {

/// Writes one file for each participant. Answers are identified by rendering, or by trial where `naming` is null. Facts,
/// debriefing and the times of the preparation are left out. Erased participants have no script.
void writeScripts(const database::StudyStore& store, const records::Naming* naming, const std::filesystem::path& out);

/// Names of scripts in a folder that hold a session of a participant whose answers were erased since.
std::vector<std::string> scriptsOfErased(const database::StudyStore& store, const std::filesystem::path& folder);

}  // namespace study::players
