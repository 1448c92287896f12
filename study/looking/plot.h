// Lines over axes with units, and the steps of axes and scale bars that people can read off.
#pragma once

#include <QColor>
#include <QFont>
#include <QPainter>
#include <QString>
#include <vector>

namespace study::looking {

struct SheetStyle {
    QColor background, surface, text, quietText, line, accent, attention, onAttention;
    QColor body;            ///< of reliefs
    double fontPx = 15;     ///< of plain text
    int columnPx = 460;     ///< one signal takes so much
    double pixelRatio = 1;  ///< of the screen
};
SheetStyle lightSheet();
SheetStyle darkSheet();

QFont fontOf(const SheetStyle& style, double factor = 1, bool isBold = false);

/// 1, 2 or 5 times a power of ten: the largest that is not above `most`. `most` > 0.
double roundStep(double most);
/// Multiples of a round step within the bounds, about `wanted` of them.
std::vector<double> ticksBetween(double low, double high, int wanted);
/// A tick in as few digits as its step needs: "0.05", "20".
QString tickText(double value, double step);

struct Axis {
    double low = 0, high = 1;
    QString unit;
    bool isLogarithmic = false;  ///< the values are decimal logarithms, and labelled by what they are of
};

/// Where the curves go: axes, grid and labels are drawn around it.
QRectF drawAxes(QPainter& painter, const QRectF& place, const Axis& x, const Axis& y, const SheetStyle& style);

/// Where there are many samples a pixel, from the lowest to the highest of each. NaN leaves a gap.
void drawCurve(QPainter& painter, const QRectF& inside, const Axis& x, const Axis& y, const std::vector<double>& places,
               const std::vector<double>& values, const SheetStyle& style);

/// A bar of a round length and its label, in `place`; `pixelsPerUnit` of the picture that it belongs to.
void drawScaleBar(QPainter& painter, const QRectF& place, double pixelsPerUnit, const QString& unit, const SheetStyle& style);

/// Writes the caption at the top of the place; what is left lies below it.
QRectF belowCaption(QPainter& painter, const QRectF& place, const QString& caption, const SheetStyle& style);

/// Around the values with some room; one that is even gets a height of its own.
Axis axisAround(const std::vector<double>& values, const QString& unit);

}  // namespace study::looking
