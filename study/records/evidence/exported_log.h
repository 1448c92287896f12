// The log in an export: every entry with its clear part and its hashes, the acts with theirs, and the recipe by which anyone
// computes the hashes again without this program. Nothing in it says what was shown or answered.
#pragma once

#include <filesystem>

#include "database/study_store.h"

namespace study::records {

/// Writes log.csv (one row an entry), acts.csv (one row an act, acts.h) and log.txt (what their columns are, and how to compute
/// the hashes from them) into an existing folder. Returns the head that the file ends with: a running session may have added
/// entries since the caller read the head. Throws environmentFault.
database::LogHead writeExportedLog(const database::StudyStore& store, const std::filesystem::path& folder);

}  // namespace study::records
