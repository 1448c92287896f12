// Curves over axes with units, and round steps for axes and scale bars.
#pragma once

#include <QColor>
#include <QFont>
#include <QPainter>
#include <QString>
#include <vector>

namespace study::looking {

/// Colours and sizes of a sheet.
struct SheetStyle {
    QColor background, surface, text, quietText, line, accent, attention, onAttention;
    QColor body;            ///< colour of reliefs
    double fontPx = 15;     ///< size of plain text, px
    int columnPx = 460;     ///< width of one signal, px
    double pixelRatio = 1;  ///< device pixels per px
};
SheetStyle lightSheet();
SheetStyle darkSheet();

QFont fontOf(const SheetStyle& style, double factor = 1, bool isBold = false);

/// The largest of 1, 2 or 5 times a power of ten that is not above `most`. `most` > 0.
double roundStep(double most);
/// About `wanted` multiples of a round step within the bounds.
std::vector<double> ticksBetween(double low, double high, int wanted);
/// Text of a tick with as few digits as its step needs: "0.05", "20".
QString tickText(double value, double step);

struct PlotAxis {
    double low = 0, high = 1;
    QString unit;
    bool isLogarithmic = false;  ///< low and high are decimal logarithms; labels show the numbers
};

/// Draws axes, grid and labels, and returns the area for the curves.
QRectF drawAxes(QPainter& painter, const QRectF& place, const PlotAxis& x, const PlotAxis& y, const SheetStyle& style);

/// Draws a curve. If a pixel column has many samples, it is filled from the lowest to the highest. NaN leaves a gap.
void drawCurve(QPainter& painter, const QRectF& inside, const PlotAxis& x, const PlotAxis& y, const std::vector<double>& places,
               const std::vector<double>& values, const SheetStyle& style);

/// Draws a scale bar of a round length with its label. `pixelsPerUnit`: scale of the picture above it.
void drawScaleBar(QPainter& painter, const QRectF& place, double pixelsPerUnit, const QString& unit, const SheetStyle& style);

/// Draws the caption at the top of `place` and returns the area below it.
QRectF belowCaption(QPainter& painter, const QRectF& place, const QString& caption, const SheetStyle& style);

/// Axis around the values with a margin. Equal values get a range of their own.
PlotAxis axisAround(const std::vector<double>& values, const QString& unit);

}  // namespace study::looking
