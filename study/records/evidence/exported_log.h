// The log in an export: every entry with its clear part and its hashes, and the recipe by which anyone computes the head again
// without this program. Nothing in it says what was shown or answered.
#pragma once

#include <filesystem>

#include "database/study_store.h"

namespace study::records {

/// Writes log.csv (one row an entry) and log.txt (what its columns are, and how to compute the head from them) into an existing
/// folder. Returns the head that the file ends with: a running session may have added entries since the caller read the head.
/// Throws environmentFault.
database::LogHead writeExportedLog(const database::StudyStore& store, const std::filesystem::path& folder);

}  // namespace study::records
