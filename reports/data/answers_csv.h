// Answers of an experiment that was not run with this program. One row a participant x fabric x condition:
// `participant,fabric,condition,Q1_correct,Q2,Q3,Q4`, and optionally `Q1_seconds`, `Q1_answer`, `group` (of the participant),
// `session`, `repetition` and `instruction` (which allow several rows of one cell), `trial` and `sitting` (the order in time).
// `instruction` is what the participant was asked for, such as speed or accuracy: a factor of the report.
// A table with one row an answer is read, too (answer_rows.h).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocols/protocol.h"
#include "reports/data/answer_rows.h"
#include "reports/data/study_data.h"

namespace reports {

/// m of choices where nobody states it.
inline constexpr int usualAlternatives = 3;

struct AnswersCsvOptions {
    std::optional<protocols::Protocol> protocol;  ///< bounds, planned contrasts, kinds and sentences of the questions
    std::string protocolSha256;                   ///< hash of the protocol's file
    std::optional<int> alternatives = {};         ///< m of choices that neither protocol nor own export describes
    AnswerRowsOptions rows = {};                  ///< encoding, and names of columns
    std::optional<std::pair<double, double>> equivalenceBounds = {};  ///< instead of the protocol's
    std::vector<std::pair<std::string, std::string>> planned = {};    ///< contrasts instead of the protocol's
    std::optional<protocols::RatingScale> scale = {};            ///< of ratings that the protocol does not describe (0 to 10)
    std::function<void(const std::string& sentence)> note = {};  ///< gets what was found in the file and what is not analysed
};

/// Column ID_correct (0 or 1) makes ID a choice question. A column named Q and digits, or like a question of the protocol, holds
/// ratings, or words where the protocol asks for words. ID_seconds and ID_answer belong to ID. `trial` is the place of
/// the row in the participant's running order, `sitting` its sitting, both from 1; ID_trial and ID_sitting hold for one question
/// only. Without `sitting`, the sessions of a participant count as sittings in the order of their rows. Participants, fabrics and
/// conditions keep the order of their first appearance; "h_g+f_g" reads as "h_g&f_g", also in options.planned. Empty, NA and NaN
/// cells are missing. Columns with other names are not analysed; options.note names them. It also names choices that are tested
/// against the default of 1/3. The answers to a question of same or different are "same" and "different", in any case of letters.
/// Throws badInput naming row and column: a missing or malformed column, a column Q1_x with an unknown x, a doubled row, a value
/// that is no number, a negative time, a participant in two groups, a rating outside the scale; a contrast of options.planned
/// that repeats an earlier one, in either order, or names one condition twice or an unknown one; a score of an export that the
/// fabric chosen contradicts; at least five choices, of which each score contradicts its answer; answers or trays of an export of
/// another kind or number than the protocol's; an options.scale of other ends than a protocol that describes all ratings. In
/// other tables options.note counts the scores that contradict, because answers may be places called like fabrics. Where neither
/// the protocol nor options.scale names a scale, it is 0 to 10; for an export of this program options.note then names ratings
/// outside it instead.
StudyData readAnswersCsv(const std::filesystem::path& file, const AnswersCsvOptions& options = {});

}  // namespace reports
