// Picture of a stroke: the recorded signals, the part that was kept, and the coefficient of that part.
#pragma once

#include <string>

#include "rendering/fabrics/recordings/friction_preparation.h"

namespace rendering::fabrics {

/// Self-contained SVG of 900 x 600. Long records are drawn as the least and greatest value of each of 800 columns.
std::string frictionPlot(const std::string& title, const RawRecord& record, const PreparedRecord& prepared);

}  // namespace rendering::fabrics
