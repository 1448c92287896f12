// The response time of an answer. Every number on times in the report comes through here, so that their definition stands in one
// place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/data/study_data.h"

namespace reports {

/// Response time, s: from the first touch of the screen to the answer. Where no touch was stamped, it runs from the moment when
/// the tray was ready. Answers of other experiments bring their own times. None: no time was recorded.
std::optional<double> responseTimeOf(const StudyResponse& response);

/// The response times of the answers that carry one, s.
std::vector<double> responseTimesOf(const std::vector<const StudyResponse*>& responses);

/// Natural logarithm of the response time in seconds; none for a time that is not positive.
std::optional<double> logTimeOf(const StudyResponse& response);

/// The definition as a sentence of the report.
std::string responseTimeSentence();

}  // namespace reports
