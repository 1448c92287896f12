// Who took part, in one sentence for a report: counts and facts, never a person.
#pragma once

#include <string>

#include "database/study_store.h"

namespace study::records {

/// "10 participants (6 female, 4 male; age mean 24.3, SD 2.1, 21 to 29; 9 right-handed, 1 not told)". Facts
/// whose values are all numbers are described, others counted; values of fewer than two people stand as
/// "other" where five or more took part, so that nobody is singled out. Empty while nobody gave any fact.
std::string participantsSentence(const database::StudyStore& store);

}  // namespace study::records
