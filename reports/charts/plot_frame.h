// What all figures by condition share: axes, gridlines, condition labels, and bands that name the groups of conditions.
#pragma once

#include <string>
#include <vector>

#include "protocols/files/svg_drawing.h"
#include "reports/charts/figure_width.h"
#include "stats/kernels/value.h"

namespace reports {

struct FrameSize {
    FigureWidth width = FigureWidth::TwoColumns;
    int legendRows = 1;  ///< lines of text above the plot
};

/// One slot along the x axis for each condition; the y axis runs from `low` to `high`.
class PlotFrame {
public:
    /// `title` and `description` are for readers who cannot see the figure.
    PlotFrame(const std::vector<std::string>& conditions, double low, double high, const std::string& title,
              const std::string& description, const FrameSize& size = {});

    protocols::SvgDrawing& drawing() { return m_drawing; }
    const std::vector<std::string>& conditions() const { return m_conditions; }
    /// Groups are shown where every condition belongs to one.
    bool hasGroups() const;

    double left() const;
    double rightEdge() const { return left() + plotWidth(); }
    double plotWidth() const { return m_slot * static_cast<double>(m_conditions.size()); }
    double slot() const { return m_slot; }  ///< width of one condition, px
    double centre(std::size_t condition) const { return left() + (static_cast<double>(condition) + 0.5) * m_slot; }
    double y(double value) const { return m_top + height * (1 - (value - m_low) / (m_high - m_low)); }

    void drawFrame(const std::string& axisTitle);
    /// A second axis on the right in percent of `wholeValue`.
    void drawRightAxis(double wholeValue, const std::string& axisTitle);
    /// Cut at the ends of the axis, without a cap where it is cut; nothing where the interval does not exist.
    void drawErrorBar(double x, const stats::Interval& interval, const std::string& colour);
    /// A line of text above the plot, on its left or its right.
    void drawLegendText(double x, protocols::SvgAnchor anchor, const std::string& escapedText, int row = 0);
    /// A remark beside the legend's last row; in a narrow figure it is the last row.
    void drawRemark(const std::string& escapedText);
    bool isNarrow() const { return m_size.width == FigureWidth::OneColumn; }

    static constexpr double right = 84;
    static constexpr double height = 300;
    static constexpr double legendRow = 22;                              ///< height, px
    static double legendY(int row = 0) { return 17 + legendRow * row; }  ///< centre of a legend's signs

private:
    double longestLabel() const;
    double bottom() const;
    void drawLabel(std::size_t condition);
    void drawBands();

    std::vector<std::string> m_conditions;
    FrameSize m_size;
    double m_top;
    double m_low;
    double m_high;
    double m_slot;
    bool m_isCrowded;  ///< labels slant
    protocols::SvgDrawing m_drawing;
};

}  // namespace reports
