// Power of a planned study: from its protocol to the options of the simulations.
#pragma once

#include <string>

#include "protocols/protocol.h"
#include "stats/power/calibration.h"
#include "stats/power/power_plan.h"
#include "study/analyse/power/tested_questions.h"

namespace study::analyse {

/// The design of the protocol with the alternatives of the tested choices, and the default variances, stretched to the scale of
/// the tested ratings. The caller sets the simulation, and the number of participants if it differs from the protocol's.
stats::PowerOptions powerOptionsOf(const protocols::Protocol& protocol, const TestedQuestions& tested);

/// The default variances of stats::RatingTruth, stretched to this scale.
stats::RatingTruth ratingTruthOf(const protocols::RatingScale& scale);

/// Says so where the protocol's equivalence bounds are too narrow for its number of participants; empty where they are not, or
/// where no question is rated.
std::string boundsWarning(const protocols::Protocol& protocol);

/// The same design and variances without any difference between conditions, over `studies` simulated studies.
stats::CalibrationOptions calibrationOptionsOf(const stats::PowerOptions& power, std::size_t studies);

}  // namespace study::analyse
