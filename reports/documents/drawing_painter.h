// Draws the figures of the report on paper. Qt's own SVG renderer ignores the shifts of subscripts, so this one reads exactly
// what protocols/files/svg_drawing.h writes: lines, polygons, rectangles, circles, and text with tspans.
#pragma once

#include <QRectF>
#include <QSizeF>
#include <string>

class QPainter;

namespace reports {

/// Size of a drawing in its own units; empty for text that is no drawing of this program.
QSizeF drawingSize(const std::string& svg);

/// Paints the drawing into `target`, which should have its proportions.
void paintDrawing(QPainter& painter, const std::string& svg, const QRectF& target);

}  // namespace reports
