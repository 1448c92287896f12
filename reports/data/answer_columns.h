// The header of a table of answers: which column holds what of which question.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/answer_rows.h"
#include "reports/data/answers_csv.h"
#include "reports/data/study_data.h"

namespace reports {

/// Where the table holds the answers to one question.
struct QuestionColumns {
    QuestionInfo info;
    std::optional<std::size_t> value = {};  ///< ID_correct, the rating or the words
    std::optional<std::size_t> time = {}, answer = {}, trial = {}, sitting = {};
    std::optional<std::size_t> slot = {}, touchedBy = {}, entries = {}, late = {};  ///< of an own export
};

struct AnswerColumns {
    std::vector<QuestionColumns> questions;  ///< in the order of their columns of answers
    std::optional<std::size_t> trial, sitting, instruction, anchor;
    std::vector<std::string> unused;  ///< columns that are not analysed
};

/// Reads the header of the wide table. Throws badInput, naming the file by `where`, as readAnswersCsv() says.
AnswerColumns answerColumnsOf(const AnswerRows& rows, const AnswersCsvOptions& options, const std::string& where);

/// Whether the protocol has a scale that counts for these columns: it describes one of their ratings, or they have none.
bool isRatedOnScaleOf(const protocols::Protocol& protocol, const AnswerColumns& columns);

}  // namespace reports
