// The part of the report's analysis that grows linearly with the answers: means and intervals, tests with the participant as the
// unit, speed and accuracy. Its values are those that `vis2hap report` gives for the same answers.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "study/simulation/simulate_in_memory.h"

namespace study::simulation {

/// `answers`: of all participants, in the order of their numbers. Participants who withdrew are not analysed. What is left out
/// stands in `designLimits` as sentences; its values are undefined.
reports::StudyAnalysis analysisOf(const MemoryStudy& study, const std::vector<SimulatedAnswers>& answers);

}  // namespace study::simulation
