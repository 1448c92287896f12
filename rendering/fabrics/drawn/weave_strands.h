// The yarns of a weave, laid onto a canvas. Each place of the fabric has its own irregularity, so windows of one fabric agree
// wherever they overlap.
#pragma once

#include "rendering/fabrics/drawn/cloth_frame.h"
#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/drawn/strand_canvas.h"

namespace rendering::fabrics {

void layWeave(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame);

}  // namespace rendering::fabrics
