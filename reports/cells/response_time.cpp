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

std::string responseTimeSentence(TimesTaken times)
{
    switch (times) {
        case TimesTaken::ToBeginning:
            return "Response time runs from the first touch of the display to the beginning of the answer. The beginning is the "
                   "first key of its entry, or the key or pedal that marks the spoken word. Where a stamp is missing, the time "
                   "is "
                   "missing.";
        case TimesTaken::ToEntry:
            return "Response time runs from the first touch, or from the moment when the tray was ready, to the entry of the "
                   "answer. "
                   "It contains the operator's typing, because whole sittings lack the stamp of the beginning of answers, as in "
                   "studies that an older version of the program began.";
        case TimesTaken::AsRecorded:
            return "The response times are those of the file. This program does not know how they were measured.";
    }
    return {};
}

}  // namespace reports
