// Speed against accuracy, from milliseconds to people: for each rendering of a study with a quality factor its time, the error of
// its signal, what the finger gets, and what participants answered. Nothing is computed here that has no other place in the
// analysis; the rows only put it side by side.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// One question of the chain.
struct ChainQuestion {
    std::string id;
    bool isChoice = false;              ///< shares correct; else means on the scale
    double low = 0, high = 1;           ///< what figures show: 0 to 1, or the scale
    std::optional<double> chance = {};  ///< of a choice; none where no condition is tested against it
    std::vector<std::string> untested;  ///< conditions that are not tested against chance
};

/// Share correct with Wilson's interval, or the mean rating with the interval over participants' means.
struct ChainAnswer {
    stats::Value value;
    stats::Interval ci95;
};

struct ChainRow {
    RenderingPrice price;
    std::vector<ChainAnswer> answers;  ///< by question of the chain
    stats::Value matchesPerRendering;  ///< of the first choice question
    stats::Value bitsPerSecond;        ///< of the first choice question
    stats::Interval bitsPerSecondCi95;
};

struct QualityChain {
    std::vector<ChainQuestion> questions;
    std::vector<ChainRow> rows;  ///< in the order of the paper; of one condition the usual quality, fast, balanced, accurate
};

/// What the intervals of the answers count as samples, as sentences without the last full stop; empty without questions.
std::string answerIntervalsText(const QualityChain& chain);

/// No rows where no condition carries a quality. `analysis`: of an unblinded study.
QualityChain qualityChain(const StudyAnalysis& analysis);

}  // namespace reports
