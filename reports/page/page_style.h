// The style sheet of the report's page, for screen and paper.
#pragma once

#include <string>

namespace reports {

std::string pageStyle();

}  // namespace reports
