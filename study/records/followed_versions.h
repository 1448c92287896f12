// The versions of an amended protocol: which of them states the plan, and which sentences were read to the analysed participants.
// A study that was never amended has one version.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"
#include "reports/data/study_data.h"

namespace study::records {

/// The last version before the first answer and before the unblinding. A later one may have been chosen by what was known.
database::ProtocolVersion versionBeforeAnswers(const database::StudyStore& store);

/// Sets the versions of an amended protocol, and the sentences of questions and instructions by the versions of the analysed
/// participants who answered. A question without answers has the sentence of the latest version. Changes nothing of a study with
/// one version.
void describeWordings(const database::StudyStore& store, const std::vector<database::CurrentAnswer>& answers,
                      reports::StudyData& data);

/// The language of the participants where it is not English alone, and the versions that they followed, as sentences.
std::vector<std::string> followedSentences(const database::StudyStore& store);

}  // namespace study::records
