// The participants of a study in one sentence for a report: counts and facts, never a single person.
#pragma once

#include <string>

#include "database/study_store.h"

namespace study::records {

/// For instance "10 participants (age mean 24.3, SD 2.1, 21 to 29; gender: 6 female, 4 male; handedness: 9 right, 1 not
/// stated).". Facts whose values are all numbers are described, other facts are counted. Where five or more took part, values
/// of one person only are counted as "other", so that nobody can be identified. Empty while there are no facts.
std::string participantsSentence(const database::StudyStore& store);

}  // namespace study::records
