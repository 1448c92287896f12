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

/// Width of the drawings that fill the width of a text, in their own units.
inline constexpr double fullDrawingWidth = 900;

/// Share of the text that the drawing is wide, at most 1: letters of a narrow drawing are as large as those of a wide one.
double shareOfTextWidth(const std::string& svg);

/// Paints the drawing into `target`, which should have its proportions.
void paintDrawing(QPainter& painter, const std::string& svg, const QRectF& target);

}  // namespace reports
