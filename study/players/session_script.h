// Recorded sessions as scripts (schema vis2hap.script/1) that replay to the same rows.
#pragma once

#include <filesystem>

#include "study/records/stored_study.h"

namespace study::players {

/// A file a participant. Answers stand by rendering once the study is unblinded, else by trial; facts,
/// debriefing and the pace of preparation are left out. Erased participants have no script.
void writeScripts(const database::StudyStore& store, const records::Naming& naming, const std::filesystem::path& out);

}  // namespace study::players
