#include "reports/figures/figure.h"

namespace reports {

std::string stampedCaption(const StudyData& data, const std::string& caption)
{
    return caption + (data.simulated ? " SIMULATED participants." : "");
}

}  // namespace reports
