#include "reports/charts/plot_frame.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/number_text.h"
#include "reports/charts/chart_colours.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"

namespace reports {

using protocols::SvgAnchor;
namespace {

constexpr double labelCharacter = 9;  ///< width, px

/// Least widths of the plot and of a condition, px.
struct LeastWidths {
    double plot, slot;
};

LeastWidths leastWidths(FigureWidth width)
{
    return width == FigureWidth::OneColumn ? LeastWidths{330, 30} : LeastWidths{800, 64};
}

double slotWidth(std::size_t conditions, FigureWidth width)
{
    const auto [plot, slot] = leastWidths(width);
    return std::max(slot, plot / std::max<double>(1, static_cast<double>(conditions)));
}

/// A step of 1, 2, 2.5 or 5 times a power of ten that divides the range into at most five parts.
double niceStep(double range)
{
    const double raw = range / 5;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double step : {1.0, 2.0, 2.5, 5.0})
        if (step * power >= raw * 0.999) return step * power;
    return 10 * power;
}

}  // namespace

PlotFrame::PlotFrame(const std::vector<std::string>& conditions, double low, double high, const std::string& title,
                     const std::string& description, const FrameSize& size)
    : m_conditions(conditions),
      m_size(size),
      m_top(40 + legendRow * size.legendRows),
      m_low(low),
      m_high(high),
      m_slot(slotWidth(conditions.size(), size.width)),
      m_isCrowded(longestLabel() > m_slot - 8),
      m_drawing(left() + plotWidth() + right, m_top + height + bottom(), title, description)
{
}

bool PlotFrame::hasGroups() const
{
    return std::all_of(m_conditions.begin(), m_conditions.end(), [](const std::string& one) { return groupOf(one).has_value(); });
}

/// Slanting labels reach to the left of their slot, so the first of them needs room.
double PlotFrame::left() const { return m_isCrowded ? std::max(76.0, longestLabel() * 0.82 - m_slot / 2 + 12) : 76; }

double PlotFrame::bottom() const { return m_isCrowded ? 56 + std::min(120.0, longestLabel() * 0.62) : 62; }

double PlotFrame::longestLabel() const
{
    double longest = 0;
    for (const std::string& condition : m_conditions) longest = std::max(longest, labelLength(condition) * labelCharacter);
    return longest;
}

void PlotFrame::drawFrame(const std::string& axisTitle)
{
    drawBands();
    const double step = niceStep(m_high - m_low);
    for (const double value : protocols::multiplesBetween(m_low, m_high, step)) {
        const bool isBottom = value == m_low;
        m_drawing.line({left(), y(value)}, {rightEdge(), y(value)}, isBottom ? ChartColours::ink : ChartColours::faint,
                       isBottom ? 1.5 : 1);
        m_drawing.text({left() - 10, y(value) + 5}, protocols::shortest(std::round(value * 1e6) / 1e6),
                       {.anchor = SvgAnchor::End});
    }
    m_drawing.line({left(), m_top}, {left(), m_top + height}, ChartColours::ink, 1.5);
    m_drawing.text({left() - 56, m_top + height / 2}, axisTitle, {.size = 15, .rotation = -90});
    for (std::size_t i = 0; i < m_conditions.size(); ++i) drawLabel(i);
    m_drawing.text({left() + plotWidth() / 2, m_top + height + bottom() - 8}, "condition", {.size = 15});
}

void PlotFrame::drawRightAxis(double wholeValue, const std::string& axisTitle)
{
    for (const int percent : {0, 25, 50, 75, 100}) {
        const double at = y(wholeValue * percent / 100);
        m_drawing.line({rightEdge(), at}, {rightEdge() + 5, at}, ChartColours::ink, 1.5);
        m_drawing.text({rightEdge() + 10, at + 5}, std::to_string(percent) + " %",
                       {.size = 13, .anchor = SvgAnchor::Start, .colour = ChartColours::grey});
    }
    m_drawing.line({rightEdge(), m_top}, {rightEdge(), m_top + height}, ChartColours::ink, 1.5);
    m_drawing.text({rightEdge() + right - 8, m_top + height / 2}, axisTitle, {.colour = ChartColours::grey, .rotation = -90});
}

void PlotFrame::drawErrorBar(double x, const stats::Interval& interval, const std::string& colour)
{
    if (!interval.low.exists() || !interval.high.exists()) return;
    const auto placeOf = [&](double end) { return y(std::clamp(end, m_low, m_high)); };
    m_drawing.line({x, placeOf(*interval.low)}, {x, placeOf(*interval.high)}, colour, 1.8);
    const double rounding = 1e-9 * (m_high - m_low);
    for (const double end : {*interval.low, *interval.high})
        if (end >= m_low - rounding && end <= m_high + rounding)
            m_drawing.line({x - 5, placeOf(end)}, {x + 5, placeOf(end)}, colour, 1.8);
}

void PlotFrame::drawLegendText(double x, SvgAnchor anchor, const std::string& escapedText, int row)
{
    const bool isRemark = anchor == SvgAnchor::End;
    m_drawing.text(
        {x, legendY(row) + 5}, escapedText,
        {.size = isRemark ? 13.0 : 15.0, .anchor = anchor, .colour = isRemark ? ChartColours::grey : ChartColours::ink});
}

void PlotFrame::drawRemark(const std::string& escapedText)
{
    const int row = m_size.legendRows - 1;
    if (!isNarrow()) return drawLegendText(rightEdge(), SvgAnchor::End, escapedText, row);
    m_drawing.text({left(), legendY(row) + 5}, escapedText,
                   {.size = 13, .anchor = SvgAnchor::Start, .colour = ChartColours::grey});
}

void PlotFrame::drawLabel(std::size_t condition)
{
    const std::string label = svgLabel(m_conditions[condition]);
    if (m_isCrowded)
        m_drawing.text({centre(condition) + 6, m_top + height + 22}, label,
                       {.size = 15, .anchor = SvgAnchor::End, .rotation = -35});
    else
        m_drawing.text({centre(condition), m_top + height + 24}, label, {.size = 17});
}

/// Neighbouring conditions of one group share a tinted band with its name.
void PlotFrame::drawBands()
{
    const auto& names = m_conditions;
    for (std::size_t begin = 0; begin < names.size() && hasGroups();) {
        const auto group = groupOf(names[begin]);
        std::size_t end = begin + 1;
        while (end < names.size() && groupOf(names[end]) == group) ++end;
        const double x = left() + static_cast<double>(begin) * m_slot;
        const double width = static_cast<double>(end - begin) * m_slot;
        m_drawing.rectangle({x + 2, m_top - 24}, width - 4, 20, groupColour(*group), 0.22);
        if (width > labelCharacter * static_cast<double>(nameOf(*group).size()))
            m_drawing.text({x + width / 2, m_top - 9}, nameOf(*group), {.bold = true});
        m_drawing.rectangle({x + 2, m_top}, width - 4, height, groupColour(*group), 0.05);
        begin = end;
    }
}

}  // namespace reports
