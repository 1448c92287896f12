// Where the answers of a report come from: the log of a study, and what the study was made with.
#pragma once

#include <string>

namespace reports {

struct ReportOrigin {
    std::string logHead;   ///< "SEQUENCE:HASH"; empty for answers that come without a log
    std::string madeWith;  ///< a JSON object; anything else is left out
};

}  // namespace reports
