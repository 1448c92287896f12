// Colours of a drawn fabric: plain dye, two systems of one colour each, yarn-dyed stripes and checks, prints and melange.
#pragma once

#include "rendering/fabrics/drawn/drawn_fabric.h"

namespace rendering::fabrics {

Dye drawDye(ClothKind kind, protocols::Random& random);

/// Colour of yarn number `yarn` of the warp or weft at a place of the fabric, mm. Prints reach yarns in the depth less.
Reflectance dyedColour(const DrawnFabric& fabric, bool isWarp, std::int64_t yarn, double uMm, double vMm, bool isInDepth);

}  // namespace rendering::fabrics
