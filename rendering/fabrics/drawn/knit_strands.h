// The loops of a knit, laid onto a canvas. Windows of one fabric agree wherever they overlap.
#pragma once

#include "rendering/fabrics/drawn/cloth_frame.h"
#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/drawn/strand_canvas.h"

namespace rendering::fabrics {

void layKnit(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame);

}  // namespace rendering::fabrics
