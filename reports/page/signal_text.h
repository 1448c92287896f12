// What the page says of generated against measured signals: the headline figures, the controls beside them, and what plain SSIM
// means for the pairs of the study.
#pragma once

#include <string>

#include "reports/data/study_data.h"

namespace reports {

/// HTML; empty where the study has no signals.
std::string signalsLead(const StudyData& data);

}  // namespace reports
