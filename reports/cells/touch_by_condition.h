// Scanning speed and force of the fingers by condition, with participants as a sample. Everything here holds for new
// participants and these fabrics.
#pragma once

#include <vector>

#include "reports/data/study_data.h"
#include "stats/kernels/value.h"

namespace reports {

/// One quantity of one condition.
struct TouchQuantity {
    std::size_t presentations = 0;  ///< with this quantity
    std::size_t participants = 0;   ///< with at least one of them
    stats::Value median;            ///< over presentations
    stats::Value mean;              ///< of the participants' means
    stats::Interval ci95;           ///< Student's t over the participants' means
};

struct ConditionTouch {
    TouchQuantity speedMmPerS;
    TouchQuantity forceN;
    TouchQuantity contactSeconds;
};

/// In the order of the conditions; a condition without samples has undefined values with the reason.
std::vector<ConditionTouch> touchByCondition(const StudyData& data);

/// The reason why a report has no such part.
inline constexpr const char* noFingerSamples = "no samples of the finger belong to these answers";

}  // namespace reports
