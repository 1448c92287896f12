#include "reports/cells/response_time.h"

#include <cmath>

namespace reports {

std::optional<double> responseTimeOf(const StudyResponse& response) { return response.seconds; }

std::vector<double> responseTimesOf(const std::vector<const StudyResponse*>& responses)
{
    std::vector<double> times;
    for (const StudyResponse* response : responses)
        if (const std::optional<double> time = responseTimeOf(*response)) times.push_back(*time);
    return times;
}

std::optional<double> logTimeOf(const StudyResponse& response)
{
    const std::optional<double> time = responseTimeOf(response);
    return time && *time > 0 ? std::optional(std::log(*time)) : std::nullopt;
}

std::string responseTimeSentence()
{
    return "Response time runs from the first touch to the answer, or from the moment when the tray was ready where no touch was "
           "recorded. Answers of other experiments bring their own times.";
}

}  // namespace reports
