// A stroke as a picture: what the instrument recorded, which part was kept, and the coefficient of that part.
#pragma once

#include <string>

#include "rendering/fabrics/recordings/friction_preparation.h"

namespace rendering::fabrics {

/// A self-contained SVG of 900 x 600; records of any length take the same space (least and greatest value of
/// each of 800 columns).
std::string frictionPlot(const std::string& title, const RawRecord& record, const PreparedRecord& prepared);

}  // namespace rendering::fabrics
