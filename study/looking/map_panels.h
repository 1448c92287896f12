// Panels of a map on a sheet. Each is drawn into a rectangle, with its caption at the top.
#pragma once

#include "study/looking/plot.h"
#include "study/looking/seen_signal.h"

namespace study::looking {

void drawPicture(QPainter& painter, const QRectF& place, const SeenMap& map, const SignalFacts& facts, const SheetStyle& style);
void drawRelief(QPainter& painter, const QRectF& place, const SeenMap& map, const SheetStyle& style);
/// Profile along the middle row.
void drawProfile(QPainter& painter, const QRectF& place, const SeenMap& map, const SheetStyle& style);

}  // namespace study::looking
