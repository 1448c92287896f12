// Loops, ribs and tufts above a ground, laid onto a canvas. Windows of one fabric agree wherever they overlap.
#pragma once

#include "rendering/fabrics/drawn/cloth_frame.h"
#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/drawn/strand_canvas.h"

namespace rendering::fabrics {

void layTerry(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame);
void layCorduroy(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame);
/// Tufts of a cut pile, locks of a fleece, and the nap of a brushed weave.
void layTufts(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame);

}  // namespace rendering::fabrics
