// What reports and exports show of how a study was made. Before the unblinding they name no condition, and files and programs of
// the lab may be named like the conditions they belong to.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::records {

/// StudyFacts::madeWith; until the unblinding without images and programs of the lab's own conditions.
std::string shownMadeWith(const database::StudyStore& store, const database::StudyFacts& facts);

/// After the unblinding a sentence for each program of the lab: its condition, its files and their hashes.
std::vector<std::string> programSentences(const database::StudyStore& store, const database::StudyFacts& facts);

}  // namespace study::records
