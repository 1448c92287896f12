// Contrasts of conditions in the linear mixed model of all answers (four random terms, one variance of each for all
// conditions). The claims of the report come from the variances of each pair instead; these stand beside them for comparison.
#pragma once

#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "reports/data/analysis_options.h"
#include "stats/claims/crossed_mean.h"
#include "stats/models/crossed_study.h"

namespace reports {

/// Difference a - b in the model.
struct ModelContrast {
    std::string a;
    std::string b;
    stats::CrossedMean mean;  ///< singular: the whole model is
};

/// All pairs of the conditions that have answers, in the order of the study; none where comparesAllPairs() is false.
std::vector<ModelContrast> modelContrasts(const StudyData& data, const stats::RatingModel& model);

/// One contrast with all fabrics, and with each fabric left out.
struct FabricLeftOut {
    std::string fabric;
    stats::CrossedMean mean;
};
struct LeaveOneFabricOut {
    std::string why;  ///< empty when there is such a contrast
    std::string a;
    std::string b;
    stats::CrossedMean all;
    std::vector<FabricLeftOut> without;
};

/// The primary planned contrast; without planned contrasts the paper's h_g&f_g - h&f, where both are conditions.
LeaveOneFabricOut leaveOneFabricOut(const StudyData& data, const stats::CrossedStudy& answers, const stats::RatingModel& model,
                                    Depth depth);

}  // namespace reports
