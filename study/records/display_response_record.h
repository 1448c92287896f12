// What a study keeps of its display's response: the whole file, among what it was made with, so that the hash of the study covers
// it.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::records {

/// Member of StudyFacts::madeWith.
inline constexpr const char* displayResponseField = "display_response";

/// A sentence for reports and data sheets: how the response was measured, or that it was not.
std::string displayResponseSentence(const database::StudyFacts& facts);

/// The same for data that are published: without the day, the display and the finger.
std::string publicDisplayResponseSentence(const database::StudyFacts& facts);

/// A sentence where sittings of people used a display of another name than the one that was measured; empty otherwise.
std::string otherDisplaySentence(const database::StudyStore& store, const database::StudyFacts& facts, bool namesThem);

}  // namespace study::records
