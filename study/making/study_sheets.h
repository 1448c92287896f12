// Pages to print before participants come: labels for the fabric pieces, the preparation sheet with the code of each piece, the
// session sheet on which the operator copies the head of the log, and the card of the scale to memorise.
#pragma once

#include <filesystem>

#include "database/study_store.h"

namespace study::making {

/// Writes labels.html, preparation.html, session.html and, for a protocol with ratings, scale-card.html with a card for each
/// different scale. Each page is complete in itself. Its foot names the head of the log (16 digits and the number of entries) and
/// the command that checks it. Sheets for the operator are in the language of the window, the card of the scale in that of the
/// participants. The pages name fabrics and pieces, but no condition, presentation or file code. Pages of an earlier run, also of
/// another study, are replaced. Those that this study does not have are removed. Throws environmentFault.
void writeSheets(const database::StudyStore& store, const std::filesystem::path& out);

}  // namespace study::making
