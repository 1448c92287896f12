#include "rendering/fabrics/recordings/friction_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "protocols/files/markup_text.h"
#include "protocols/files/svg_drawing.h"
#include "rendering/fabrics/recordings/friction_report.h"
#include "rendering/fabrics/recordings/record_text.h"

namespace rendering::fabrics {

namespace {

using protocols::SvgAnchor;
using protocols::SvgDrawing;
using protocols::SvgPoint;

constexpr double left = 70, width = 800, right = left + width;

void writeText(SvgDrawing& drawing, double x, double y, const std::string& words, SvgAnchor anchor = SvgAnchor::Start)
{
    drawing.text({x, y}, protocols::escapedMarkup(readable(words)), {.size = 12, .anchor = anchor, .colour = "#333"});
}

/// Frame with time along x and values along y.
struct PlotPanel {
    double top, height, fromS, toS, low, high;

    double x(double timeS) const { return left + width * (timeS - fromS) / std::max(toS - fromS, 1e-300); }
    double y(double value) const { return top + height * (1 - (value - low) / (high - low)); }

    void drawFrame(SvgDrawing& drawing, const std::string& unit) const
    {
        drawing.rectangle({left, top}, width, height, "none", 1, "#888");
        for (const double share : {0.0, 0.5, 1.0}) {
            const double value = low + share * (high - low);
            writeText(drawing, left - 6, y(value) + 4, fourFigures(value), SvgAnchor::End);
            writeText(drawing, left + share * width, top + height + 16, fourFigures(fromS + share * (toS - fromS)) + " s",
                      share == 0   ? SvgAnchor::Start
                      : share == 1 ? SvgAnchor::End
                                   : SvgAnchor::Middle);
        }
        writeText(drawing, left, top - 6, unit);
    }

    void drawBand(SvgDrawing& drawing, double from, double to, const char* colour) const
    {
        const double a = std::clamp(x(from), left, right), b = std::clamp(x(to), left, right);
        drawing.rectangle({a, top}, std::max(b - a, 0.5), height, colour);
    }

    /// Line of at most about 800 columns, each drawn from its least to its greatest value.
    void drawLine(SvgDrawing& drawing, std::size_t count, const auto& timeAt, const auto& valueAt, const char* colour) const
    {
        std::vector<SvgPoint> points;
        const std::size_t together = std::max<std::size_t>(count / 800, 1);
        for (std::size_t i = 0; i < count; i += together) {
            double least = valueAt(i), most = least;
            for (std::size_t k = i; k < std::min(i + together, count); ++k) {
                least = std::min(least, valueAt(k));
                most = std::max(most, valueAt(k));
            }
            points.push_back({x(timeAt(i)), y(least)});
            if (together > 1) points.push_back({x(timeAt(i)), y(most)});
        }
        drawing.polyline(points, colour, 1);
    }
};

PlotPanel panelFor(double top, double height, double fromS, double toS, double low, double high)
{
    const double margin = high > low ? 0.05 * (high - low) : std::max(std::abs(low) * 0.1, 1e-9);
    return {top, height, fromS, toS, low - margin, high + margin};
}

void drawRecorded(SvgDrawing& drawing, const RawRecord& record, const PreparedRecord& prepared)
{
    double low = 0, high = 0;  // The axis of forces includes 0.
    if (prepared.normalN.empty()) low = high = prepared.tangentialN.front();
    for (const auto* values : {&prepared.normalN, &prepared.tangentialN})
        for (const double value : *values) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    const auto& time = prepared.timeS;
    const PlotPanel panel = panelFor(60, 200, time.front(), time.back(), low, high);
    const RowRange steady = prepared.slide.steady;
    panel.drawBand(drawing, time[steady.begin], time[steady.end - 1], "#dcefdc");
    if (prepared.zeroRows) panel.drawBand(drawing, time[prepared.zeroRows->begin], time[prepared.zeroRows->end - 1], "#dce6f5");
    const auto timeAt = [&](std::size_t i) { return time[i]; };
    panel.drawLine(
        drawing, time.size(), timeAt, [&](std::size_t i) { return prepared.tangentialN[i]; }, "#b3401f");
    if (!prepared.normalN.empty())
        panel.drawLine(
            drawing, time.size(), timeAt, [&](std::size_t i) { return prepared.normalN[i]; }, "#1f4fb3");
    panel.drawFrame(drawing,
                    prepared.normalN.empty() ? "recorded: " + record.quantity : "recorded, N: normal (blue), tangential (red)");
    writeText(drawing, right, 54,
              std::string("green: steady slide, kept") + (prepared.zeroRows ? "; pale blue: unloaded, zero" : ""),
              SvgAnchor::End);
}

void drawKept(SvgDrawing& drawing, const RawRecord& record, const PreparedRecord& prepared)
{
    const auto valueAt = [&](std::size_t i) {
        return prepared.evenNormalN.empty() ? prepared.values[i] : prepared.values[i] / prepared.evenNormalN[i];
    };
    double low = valueAt(0), high = low;
    for (std::size_t i = 0; i < prepared.values.size(); ++i) {
        low = std::min(low, valueAt(i));
        high = std::max(high, valueAt(i));
    }
    const double from = prepared.timeS[prepared.slide.steady.begin];
    const auto timeAt = [&](std::size_t i) { return from + double(i) * prepared.stepS; };
    const PlotPanel panel = panelFor(330, 180, from, timeAt(prepared.values.size() - 1), low, high);
    panel.drawLine(drawing, prepared.values.size(), timeAt, valueAt, "#333");
    drawing.line({left, panel.y(prepared.mean)}, {right, panel.y(prepared.mean)}, "#b38f1f", 1, "6 4");
    panel.drawFrame(drawing,
                    "kept: " + (prepared.evenNormalN.empty() ? record.quantity : std::string("coefficient of friction")) + ", " +
                        std::to_string(prepared.values.size()) + " samples at " + fourFigures(1 / prepared.stepS) + " Hz");
    writeText(drawing, right, 324, "mean " + fourFigures(prepared.mean) + " (dashed), sd " + fourFigures(prepared.sd),
              SvgAnchor::End);
}

/// The processing in words, broken into lines of 120 characters; wide letters need 7 px.
void drawFootnote(SvgDrawing& drawing, const PreparedRecord& prepared)
{
    std::string words = describeCuts(prepared).substr(2);
    for (double y = 550; !words.empty(); y += 16) {
        std::size_t end = words.size();
        if (end > 120) end = std::min(words.rfind(' ', 120), end);
        writeText(drawing, left, y, words.substr(0, end));
        words.erase(0, end + 1);
    }
}

}  // namespace

std::string frictionPlot(const std::string& title, const RawRecord& record, const PreparedRecord& prepared)
{
    SvgDrawing drawing(900, 600, readable(title), "The recorded stroke, and the part of it that was kept.");
    drawing.rectangle({0, 0}, 900, 600, "#fff");
    writeText(drawing, left, 24, title);
    drawRecorded(drawing, record, prepared);
    drawKept(drawing, record, prepared);
    drawFootnote(drawing, prepared);
    return drawing.finished();
}

}  // namespace rendering::fabrics
