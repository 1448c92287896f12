// Answers of an experiment that was not run with this program. One row a participant x fabric x condition:
// `participant,fabric,condition,Q1_correct,Q2,Q3,Q4`, and optionally `Q1_seconds`, `Q1_answer`, `group` (of the participant),
// `session` and `repetition` (which allow several rows of one cell), `trial` and `sitting` (the order in time).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "protocols/protocol.h"
#include "reports/data/study_data.h"

namespace reports {

struct AnswersCsvOptions {
    std::optional<protocols::Protocol> protocol;  ///< bounds, planned contrasts, kinds and sentences of the questions
    std::string protocolSha256;                   ///< hash of the protocol's file
    int alternatives = 3;                         ///< m of choices that the protocol does not describe
};

/// Column ID_correct (0 or 1) makes ID a choice question. A column named Q and digits, or like a question of the protocol, holds
/// ratings, or words where the protocol asks for words. ID_seconds and ID_answer belong to ID. `trial` is the place of
/// the row in the participant's running order, `sitting` its sitting, both from 1; ID_trial and ID_sitting hold for one question
/// only. Without `sitting`, the sessions of a participant count as sittings in the order of their rows. Participants, fabrics and
/// conditions keep the order of their first appearance; "h_g+f_g" reads as "h_g&f_g". Empty, NA and NaN cells are missing.
/// Throws badInput naming row and column: a missing, unknown or malformed column, a doubled row, a value that is no number or
/// lies outside the protocol's scale, a participant in two groups.
StudyData readAnswersCsv(const std::filesystem::path& file, const AnswersCsvOptions& options = {});

}  // namespace reports
