// Small panels, one for each column, so that numbers of different size stay legible.
#include "rendering/models/training_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "protocols/files/markup_text.h"
#include "protocols/files/svg_drawing.h"
#include "rendering/models/training_table.h"

namespace rendering::models {

namespace {

using protocols::SvgAnchor;
using protocols::SvgDrawing;
using protocols::SvgPoint;
using protocols::SvgText;

constexpr int panelWidth = 440, panelHeight = 190, left = 62, right = 16, top = 30, bottom = 30, mostPoints = 220;
constexpr std::size_t mostMarked = 40;  ///< longer curves have no marks at their points
constexpr const char* curveColour = "#0b4f8a";
constexpr double logarithmicFrom = 30;  ///< ratio of the greatest to the least value
constexpr double constantBelow = 1e-9;  ///< share of the greatest size of a value; a smaller range is drawn as a constant
constexpr double leastRange = 1e-300;   ///< smaller ranges have no digits left
constexpr double mostDecades = 12;      ///< labelled decades of a logarithmic axis

struct CurvePoint {
    double step = 0, mean = 0, low = 0, high = 0;
};

/// Averages over neighbouring steps, so that the size of the picture is bounded.
std::vector<CurvePoint> pointsOf(const TrainingTable& table, const std::string& name)
{
    const std::vector<double> values = table.column(name);
    std::vector<std::pair<int, double>> there;
    std::size_t next = 0;
    for (const auto& [step, row] : table.rows)
        if (const double value = values[next++]; std::isfinite(value)) there.emplace_back(step, value);
    const std::size_t together = (there.size() + mostPoints - 1) / mostPoints;
    std::vector<CurvePoint> points;
    for (std::size_t from = 0; from < there.size(); from += together) {
        const std::size_t end = std::min(there.size(), from + together);
        CurvePoint point{0, 0, there[from].second, there[from].second};
        for (std::size_t i = from; i < end; ++i) {
            point.step += there[i].first / static_cast<double>(end - from);
            point.mean += there[i].second / static_cast<double>(end - from);
            point.low = std::min(point.low, there[i].second);
            point.high = std::max(point.high, there[i].second);
        }
        points.push_back(point);
    }
    return points;
}

/// "0.05", "20", "1e-05": at most three digits, with a decimal point in every locale.
std::string threeDigits(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    std::replace(text, text + sizeof text, ',', '.');
    return text;
}

struct CurveScale {
    double low = 0, high = 1;
    bool logarithmic = false;
    double placed(double value) const
    {
        // Halves, because the difference of two large numbers may exceed the range of double.
        const auto of = [this](double x) { return logarithmic ? std::log10(x) : x / 2; };
        return (of(value) - of(low)) / (of(high) - of(low));
    }
};

CurveScale scaleFor(const std::vector<CurvePoint>& points)
{
    CurveScale scale{points.front().low, points.front().high, false};
    for (const CurvePoint& point : points) {
        scale.low = std::min(scale.low, point.low);
        scale.high = std::max(scale.high, point.high);
    }
    scale.logarithmic = scale.low > 0 && scale.high > logarithmicFrom * scale.low;
    const double greatest = std::max(std::abs(scale.low), std::abs(scale.high));
    if (!(scale.high - scale.low > std::max(constantBelow * greatest, leastRange))) {
        const double room = greatest == 0 ? 1 : std::max(greatest / 10, leastRange);
        scale = {scale.low - room, scale.high + room, false};
    }
    return scale;
}

/// Round steps on a linear axis; powers of ten, or the two ends, on a logarithmic one.
std::vector<double> ticksOf(const CurveScale& scale)
{
    if (scale.logarithmic) {
        const double from = std::log10(scale.low), to = std::log10(scale.high);
        std::vector<double> ticks = protocols::multiplesBetween(from, to, std::max(1.0, std::ceil((to - from) / mostDecades)));
        for (double& tick : ticks) tick = std::pow(10, tick);
        if (ticks.size() < 2) ticks = {scale.low, scale.high};
        return ticks;
    }
    const double least = (scale.high / 2 - scale.low / 2) / 2.5, power = std::pow(10, std::floor(std::log10(least)));
    const double step = least / power <= 2 ? 2 * power : least / power <= 5 ? 5 * power : 10 * power;
    return protocols::multiplesBetween(scale.low, scale.high, step);
}

SvgText tickStyle(SvgAnchor anchor) { return {.size = 11, .anchor = anchor, .colour = "#555"}; }

void drawCurve(SvgDrawing& drawing, const std::vector<CurvePoint>& points, const auto& x, const auto& y)
{
    std::vector<SvgPoint> band, mean;
    for (const CurvePoint& point : points) {
        band.push_back({x(point.step), y(point.high)});
        mean.push_back({x(point.step), y(point.mean)});
    }
    for (auto point = points.rbegin(); point != points.rend(); ++point) band.push_back({x(point->step), y(point->low)});
    drawing.polygon(band, "#9cc3e6", "none", 0.6);
    drawing.polyline(mean, curveColour, 1.6);
    if (points.size() > mostMarked) return;
    for (const SvgPoint& point : mean) drawing.circle(point, 2.2, curveColour, "none");
}

/// Panel `number`, two in a row.
void drawPanel(SvgDrawing& drawing, const std::string& title, const std::vector<CurvePoint>& points, double lastStep, int number)
{
    const double x0 = (number % 2) * panelWidth, y0 = (number / 2) * panelHeight;
    drawing.text({x0 + left, y0 + 18}, protocols::escapedMarkup(title),
                 {.size = 13, .anchor = SvgAnchor::Start, .colour = "#000", .bold = true});
    if (points.empty()) return drawing.text({x0 + left, y0 + 50}, "no finite values", tickStyle(SvgAnchor::Start));
    const CurveScale scale = scaleFor(points);
    const auto x = [&](double step) { return x0 + left + step / std::max(1.0, lastStep) * (panelWidth - left - right); };
    const auto y = [&](double value) { return y0 + panelHeight - bottom - scale.placed(value) * (panelHeight - top - bottom); };
    drawing.text({x0 + panelWidth - right, y0 + 18},
                 "last " + threeDigits(points.back().mean) + (scale.logarithmic ? ", logarithmic" : ""),
                 tickStyle(SvgAnchor::End));
    for (const double tick : ticksOf(scale)) {
        drawing.line({x(0), y(tick)}, {x(lastStep), y(tick)}, "#ddd", 1);
        drawing.text({x(0) - 6, y(tick) + 4}, threeDigits(tick), tickStyle(SvgAnchor::End));
    }
    for (const double tick : ticksOf({0, std::max(1.0, lastStep), false}))
        drawing.text({x(tick), y0 + panelHeight - bottom + 16}, threeDigits(tick), tickStyle(SvgAnchor::Middle));
    drawCurve(drawing, points, x, y);
}

}  // namespace

std::string curvesSvg(const TrainingTable& losses, const TrainingTable& validation)
{
    const auto lastOf = [](const TrainingTable& table) { return table.rows.empty() ? 0 : table.rows.rbegin()->first; };
    const double last = std::max(lastOf(losses), lastOf(validation));
    const auto panels = static_cast<int>(losses.names.size() + validation.names.size());
    const double width = 2 * panelWidth, height = (panels + 1) / 2 * panelHeight + 24;
    SvgDrawing drawing(width, height, "Training curves", "Losses and validation figures over the training steps.");
    drawing.rectangle({0, 0}, width, height, "#fff");
    int number = 0;
    for (const std::string& name : losses.names) drawPanel(drawing, "loss: " + name, pointsOf(losses, name), last, number++);
    for (const std::string& name : validation.names)
        drawPanel(drawing, "validation: " + name, pointsOf(validation, name), last, number++);
    drawing.text({width / 2, height - 10}, "step", tickStyle(SvgAnchor::Middle));
    return drawing.finished();
}

}  // namespace rendering::models
