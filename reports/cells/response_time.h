// The response time of an answer. Every number on times in the report comes through here, so that their definition stands in one
// place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/data/study_data.h"

namespace reports {

/// Response time, s, as StudyData::times defines it: from the first touch of the display to the beginning of the answer. Studies
/// with whole sittings of an older version keep the time to the entry; answers of other experiments bring their own times. None:
/// not recorded.
std::optional<double> responseTimeOf(const StudyResponse& response);

/// The response times of the answers that carry one, s.
std::vector<double> responseTimesOf(const std::vector<const StudyResponse*>& responses);

/// Natural logarithm of the response time in seconds; none for a time that is not positive.
std::optional<double> logTimeOf(const StudyResponse& response);

/// The definition as sentences of the report.
std::string responseTimeSentence(TimesTaken times);

}  // namespace reports
