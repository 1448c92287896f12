#include "reports/charts/speed_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/svg_drawing.h"
#include "reports/charts/chart_colours.h"
#include "reports/text/condition_label.h"

namespace reports {
namespace {

using protocols::SvgAnchor;
using protocols::SvgPoint;

constexpr double plotLeft = 76, plotTop = 24, plotHeight = 330;  // px
constexpr double legendRow = 22, legendColumn = 170;
constexpr std::size_t mostLegendRows = 16;  // in one column
constexpr std::array<const char*, 4> dashesOfLines{"", "9 5", "3 4", "12 4 3 4"};

/// A step of 1, 2 or 5 times a power of ten that divides the length into at most eight parts.
double stepOfSeconds(double length)
{
    const double raw = length / 8;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (raw <= factor * power * 1.0001) return factor * power;
    return 10 * power;
}

class SpeedDrawing {
public:
    SpeedDrawing(const SpeedPlot& plot, FigureWidth width)
        : m_plot(plot),
          m_isNarrow(width == FigureWidth::OneColumn),
          m_plotWidth(m_isNarrow ? 390 : 560),
          m_longest(longestOf(plot)),
          m_drawing(wholeWidth(), wholeHeight(), plot.title, plot.description)
    {
    }

    std::string finished()
    {
        drawFrame();
        for (std::size_t i = 0; i < m_plot.lines.size(); ++i) drawLine(i);
        for (const SpeedPoint& point : m_plot.points) drawWhiskers(point);
        for (std::size_t i = 0; i < m_plot.points.size(); ++i)
            if (isDrawn(m_plot.points[i])) drawSign(i, at(m_plot.points[i]));
        drawLegend();
        return m_drawing.finished();
    }

private:
    static bool isDrawn(const SpeedPoint& point) { return point.time.exists() && point.share.exists(); }

    std::size_t legendEntries() const
    {
        const auto named = std::ranges::count_if(m_plot.lines, [](const SpeedLine& line) { return !line.name.empty(); });
        return m_plot.points.size() + static_cast<std::size_t>(named) + (m_plot.alternatives > 0 ? 1 : 0) +
               (m_plot.deadlines.empty() ? 0 : 1);
    }

    /// The legend stands on the right of the plot; in a narrow figure it stands below, in two columns.
    std::size_t legendRows() const { return m_isNarrow ? (legendEntries() + 1) / 2 : mostLegendRows; }

    double wholeWidth() const
    {
        if (m_isNarrow) return plotLeft + m_plotWidth + 24;
        const auto columns = static_cast<double>((legendEntries() + mostLegendRows - 1) / mostLegendRows);
        return plotLeft + m_plotWidth + 30 + std::max(1.0, columns) * legendColumn + 30;
    }

    double wholeHeight() const
    {
        return plotTop + plotHeight + 72 + (m_isNarrow ? legendRow * static_cast<double>(legendRows()) + 8 : 0);
    }

    /// End of the axis of times, s. An interval that is far longer than all times is cut.
    static double longestOf(const SpeedPlot& plot)
    {
        double longest = 0, reach = 0;
        const auto take = [&](const SpeedPoint& point) {
            if (!isDrawn(point)) return;
            longest = std::max(longest, *point.time);
            reach = std::max(reach, point.secondsCi.high.orElse(0));
        };
        for (const SpeedPoint& point : plot.points) take(point);
        for (const SpeedLine& line : plot.lines)
            for (const SpeedPoint& point : line.points) take(point);
        for (const double deadline : plot.deadlines) longest = std::max(longest, deadline);
        return longest > 0 ? 1.05 * std::max(longest, std::min(reach, 1.6 * longest)) : 1;
    }

    double x(double seconds) const { return plotLeft + std::min(seconds, m_longest) / m_longest * m_plotWidth; }
    static double y(double share) { return plotTop + (1 - share) * plotHeight; }
    SvgPoint at(const SpeedPoint& point) const { return {x(*point.time), y(*point.share)}; }

    void drawFrame()
    {
        const double bottom = plotTop + plotHeight, right = plotLeft + m_plotWidth;
        for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            m_drawing.line({plotLeft, y(share)}, {right, y(share)}, ChartColours::faint, 1);
            m_drawing.text({plotLeft - 10, y(share) + 5}, protocols::shortest(share), {.anchor = SvgAnchor::End});
        }
        const double step = stepOfSeconds(m_longest);
        for (const double tick : protocols::multiplesBetween(0, m_longest * 1.0001, step)) {
            m_drawing.line({x(tick), bottom}, {x(tick), bottom + 5}, ChartColours::ink, 1.5);
            m_drawing.text({x(tick), bottom + 24}, protocols::shortest(std::round(tick * 1e6) / 1e6), {.size = 14});
        }
        m_drawing.line({plotLeft, bottom}, {right, bottom}, ChartColours::ink, 1.5);
        m_drawing.line({plotLeft, plotTop}, {plotLeft, bottom}, ChartColours::ink, 1.5);
        m_drawing.text({plotLeft - 56, plotTop + plotHeight / 2}, "share correct", {.size = 15, .rotation = -90});
        m_drawing.text({plotLeft + m_plotWidth / 2, bottom + 54}, "response time, s", {.size = 15});
        if (m_plot.alternatives > 0) {
            const double chance = 1.0 / m_plot.alternatives;
            m_drawing.line({plotLeft, y(chance)}, {right, y(chance)}, ChartColours::ink, 1.4, "7 5");
        }
        for (const double deadline : m_plot.deadlines)
            m_drawing.line({x(deadline), plotTop}, {x(deadline), bottom}, ChartColours::ink, 1.4, "2 4");
    }

    void drawWhiskers(const SpeedPoint& point)
    {
        if (!isDrawn(point)) return;
        const SvgPoint centre = at(point);
        if (point.shareCi.low.exists())
            m_drawing.line({centre.x, y(*point.shareCi.low)}, {centre.x, y(*point.shareCi.high)}, ChartColours::slate, 1.2);
        if (point.secondsCi.low.exists())
            m_drawing.line({x(*point.secondsCi.low), centre.y}, {x(*point.secondsCi.high), centre.y}, ChartColours::slate, 1.2);
    }

    void drawLine(std::size_t i)
    {
        const SpeedLine& line = m_plot.lines[i];
        const SpeedPoint* before = nullptr;
        for (const SpeedPoint& point : line.points) {
            if (!isDrawn(point)) continue;
            if (before != nullptr) m_drawing.line(at(*before), at(point), ChartColours::ink, 1.8, dashesOfLines[i % 4]);
            before = &point;
        }
        for (const SpeedPoint& point : line.points) {
            if (!isDrawn(point)) continue;
            const SvgPoint centre = at(point);
            if (point.shareCi.low.exists())
                m_drawing.line({centre.x, y(*point.shareCi.low)}, {centre.x, y(*point.shareCi.high)}, ChartColours::slate, 1.2);
            m_drawing.circle(centre, 3, ChartColours::ink, ChartColours::white);
        }
    }

    /// A number in a disc, or a circle, square, diamond or triangle.
    void drawSign(std::size_t i, SvgPoint centre)
    {
        const double r = 9;
        if (m_plot.signs == PointSigns::Numbers) {
            m_drawing.circle(centre, r, ChartColours::white, ChartColours::ink);
            m_drawing.text({centre.x, centre.y + 4}, std::to_string(i + 1), {.size = i < 9 ? 12.0 : 10.0, .bold = true});
            return;
        }
        switch (i % 4) {
            case 0:
                m_drawing.circle(centre, r - 1, ChartColours::blue, ChartColours::white);
                break;
            case 1:
                m_drawing.rectangle({centre.x - r + 1, centre.y - r + 1}, 2 * r - 2, 2 * r - 2, ChartColours::orange, 1,
                                    ChartColours::ink);
                break;
            case 2:
                m_drawing.polygon({{centre.x, centre.y - r - 1},
                                   {centre.x + r + 1, centre.y},
                                   {centre.x, centre.y + r + 1},
                                   {centre.x - r - 1, centre.y}},
                                  ChartColours::ink, ChartColours::white);
                break;
            default:
                m_drawing.polygon({{centre.x, centre.y - r}, {centre.x + r, centre.y + r - 1}, {centre.x - r, centre.y + r - 1}},
                                  ChartColours::white, ChartColours::ink);
                break;
        }
    }

    /// The place of an entry: its left end and its middle.
    SvgPoint legendPlace()
    {
        const auto row = static_cast<double>(m_entry % legendRows()), column = static_cast<double>(m_entry / legendRows());
        ++m_entry;
        if (m_isNarrow) return {20 + column * (wholeWidth() / 2 - 10), plotTop + plotHeight + 82 + row * legendRow};
        return {plotLeft + m_plotWidth + 30 + column * legendColumn, plotTop + 10 + row * legendRow};
    }

    void legendText(SvgPoint place, const std::string& escapedText)
    {
        m_drawing.text({place.x + 40, place.y + 5}, escapedText, {.size = 13, .anchor = SvgAnchor::Start});
    }

    void drawLegend()
    {
        for (std::size_t i = 0; i < m_plot.points.size(); ++i) {
            const SvgPoint place = legendPlace();
            drawSign(i, {place.x + 14, place.y});
            const std::string& name = m_plot.points[i].name;
            legendText(place, svgLabel(name) + (isDrawn(m_plot.points[i]) ? "" : svgTextAfter(name, " (no times)")));
        }
        for (std::size_t i = 0; i < m_plot.lines.size(); ++i)
            if (!m_plot.lines[i].name.empty()) legendStroke(m_plot.lines[i].name, dashesOfLines[i % 4], 1.8);
        if (m_plot.alternatives > 0) legendStroke("chance, 1/" + std::to_string(m_plot.alternatives), "7 5", 1.4);
        if (!m_plot.deadlines.empty()) legendStroke("deadline", "2 4", 1.4);
    }

    void legendStroke(const std::string& text, const char* dashes, double width)
    {
        const SvgPoint place = legendPlace();
        m_drawing.line({place.x, place.y}, {place.x + 30, place.y}, ChartColours::ink, width, dashes);
        legendText(place, protocols::escapedMarkup(text));
    }

    const SpeedPlot& m_plot;
    bool m_isNarrow;
    double m_plotWidth;
    double m_longest;
    std::size_t m_entry = 0;
    protocols::SvgDrawing m_drawing;
};

}  // namespace

std::string drawn(const SpeedPlot& plot, FigureWidth width) { return SpeedDrawing(plot, width).finished(); }

}  // namespace reports
