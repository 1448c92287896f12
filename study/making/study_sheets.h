// What is printed before participants come: labels for the fabric pieces, the preparation sheet that says
// which piece carries which code, and the card of the scale to memorise.
#pragma once

#include <filesystem>

#include "database/study_store.h"

namespace study::making {

/// Writes labels.html, preparation.html and, where something is rated, scale-card.html: each a page to print,
/// with nothing to load. Returns the exit code 0; throws environmentFault on disk faults. The sheets name
/// fabrics and pieces; no condition, no presentation, no file code.
int writeSheets(const database::StudyStore& store, const std::filesystem::path& out);

}  // namespace study::making
