// Answers of an experiment that was not run with this program: one row a participant x fabric x
// condition, `participant,fabric,condition,Q1_correct,Q2,Q3,Q4` and optionally `Q1_seconds`, `Q1_answer`.
#pragma once

#include <filesystem>
#include <optional>

#include "protocols/protocol.h"
#include "reports/data/study_data.h"

namespace reports {

struct AnswersCsvOptions {
    std::optional<protocols::Protocol> protocol;  ///< bounds, planned contrasts, scale, words of the questions
    std::string protocolSha256;                   ///< of the protocol's file
    int alternatives = 3;                         ///< m of the choices, unless the protocol says so
};

/// Columns: NAME_correct (0 or 1) makes NAME a choice question; Q and digits, or a name the protocol
/// knows, is a rating; NAME_seconds and NAME_answer belong to NAME. Participants, fabrics and conditions
/// keep the order of their first appearance; "h_g+f_g" reads as "h_g&f_g". Empty, NA and NaN are missing.
/// Throws badInput naming row and column: a missing or unknown column, a doubled row, a value that is no
/// number or outside the protocol's scale.
StudyData readAnswersCsv(const std::filesystem::path& file, const AnswersCsvOptions& options = {});

}  // namespace reports
