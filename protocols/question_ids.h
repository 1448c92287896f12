// Which ids questions may have, and the columns that a question takes in a table with one row a participant, fabric and
// condition. An id must not make two columns of such a table equal.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/protocol.h"

namespace protocols {

/// A letter, then letters, digits and underscores, at most 40 characters.
bool isQuestionId(std::string_view id);

/// "Q1", "Q1_correct", "Q1_answer", "Q1_seconds".
std::vector<std::string> columnsOf(const QuestionId& question);

/// The columns of exported answers that belong to no question, in the order of the file answers.csv.
std::span<const std::string_view> answerColumns();

/// Ids that are malformed, equal another one but for case, or take a column twice; each "place: what is wrong, what was
/// expected".
std::vector<std::string> faultsOfQuestionIds(const Protocol& protocol);

}  // namespace protocols
