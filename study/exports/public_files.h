// What a public export holds beside its tables: the licence, and how to cite the data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "protocols/protocol.h"

namespace study::exports {

inline constexpr const char* usualLicence = "CC-BY-4.0";

/// LICENSE.txt: the SPDX identifier and where its text is.
std::string licenceText(const std::string& study, const std::string& spdx);

/// CITATION.cff of format 1.2.0. Without authors it names a placeholder, which the caller asks to replace. `released`:
/// "2026-11-25".
std::string citationText(const std::string& study, const std::string& spdx, const std::vector<std::string>& authors,
                         const std::string& released);

/// Words of a participant; also an answer to a question that the protocol does not know.
bool isWorded(const protocols::Protocol& protocol, const protocols::QuestionId& question);

/// Answers that a public export leaves out.
struct LeftOutAnswers {
    std::size_t ofWithdrawn = 0;  ///< of participants who withdrew
    std::size_t inWords = 0;      ///< of the others, in their own words
};
LeftOutAnswers answersLeftOut(const database::StudyStore& store);

}  // namespace study::exports
