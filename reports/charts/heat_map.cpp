#include "reports/charts/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "protocols/files/markup_text.h"
#include "protocols/files/svg_drawing.h"
#include "reports/charts/chart_colours.h"

namespace reports {
namespace {

using protocols::SvgAnchor;

constexpr double letter = 8.2;                   // px, mean width of a letter of a label
constexpr double columnLabelsTop = 52;           // px
constexpr double narrowestCellWithText = 24;     // px
constexpr std::array darkest{0x0b, 0x3c, 0x5d};  // red, green, blue of the highest value

/// Between white and the darkest blue; `share` from 0 to 1.
std::string shadeOf(double share)
{
    std::array<char, 8> text{};
    const auto channel = [&](std::size_t i) { return static_cast<unsigned>(std::lround(255 + share * (darkest[i] - 255))); };
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", channel(0), channel(1), channel(2));
    return text.data();
}

double longestOf(const std::vector<HeatMapLabel>& labels)
{
    double longest = 0;
    for (const HeatMapLabel& label : labels) longest = std::max(longest, label.length);
    return longest * letter;
}

class HeatMapDrawing {
public:
    HeatMapDrawing(const HeatMap& map, FigureWidth width)
        : m_map(map),
          m_isNarrow(width == FigureWidth::OneColumn),
          m_left(44 + longestOf(map.rows)),
          m_cellWidth(std::clamp((wholeWidth() - m_left - 12) / std::max<double>(1, double(map.columns.size())), 20.0,
                                 m_isNarrow ? 60.0 : 92.0)),
          m_isCrowded(longestOf(map.columns) > m_cellWidth - 4),
          m_top(columnLabelsTop + (m_isCrowded ? 0.6 * longestOf(map.columns) + 22 : 24)),
          m_drawing(std::max(m_left + m_cellWidth * double(map.columns.size()) + 12 + (m_isCrowded ? 30 : 0), legendEnd()),
                    m_top + cellHeight * double(map.rows.size()) + 12, map.title, map.description)
    {
    }

    std::string finished()
    {
        drawLegend();
        drawColumnLabels();
        for (std::size_t i = 0; i < m_map.rows.size(); ++i) drawRow(i);
        m_drawing.text({16, m_top + cellHeight * double(m_map.rows.size()) / 2}, m_map.rowTitle, {.size = 14, .rotation = -90});
        return m_drawing.finished();
    }

private:
    static constexpr double cellHeight = 30;  // px
    static constexpr int legendSteps = 24;
    static constexpr double legendWidth = 144;  // px

    double wholeWidth() const { return m_isNarrow ? 490 : 900; }
    double legendLeft() const { return m_left + letter * double(m_map.lowText.size()); }
    double legendEnd() const { return legendLeft() + legendWidth + 30 + letter * double(m_map.highText.size()); }
    double x(std::size_t column) const { return m_left + double(column) * m_cellWidth; }

    void drawLegend()
    {
        m_drawing.text({legendLeft() - 8, 21}, protocols::escapedMarkup(m_map.lowText), {.size = 13, .anchor = SvgAnchor::End});
        const double step = legendWidth / legendSteps;
        for (int i = 0; i < legendSteps; ++i)
            m_drawing.rectangle({legendLeft() + i * step, 9}, step + 0.5, 14, shadeOf(double(i) / (legendSteps - 1)));
        m_drawing.text({legendLeft() + legendWidth + 8, 21}, protocols::escapedMarkup(m_map.highText),
                       {.size = 13, .anchor = SvgAnchor::Start});
    }

    void drawColumnLabels()
    {
        m_drawing.text({m_left + m_cellWidth * double(m_map.columns.size()) / 2, 46}, m_map.columnTitle, {.size = 14});
        for (std::size_t j = 0; j < m_map.columns.size(); ++j) {
            const double centre = x(j) + m_cellWidth / 2;
            if (m_isCrowded)
                m_drawing.text({centre, m_top - 6}, m_map.columns[j].svg,
                               {.size = 14, .anchor = SvgAnchor::Start, .rotation = -35});
            else
                m_drawing.text({centre, m_top - 8}, m_map.columns[j].svg, {.size = 14});
        }
    }

    void drawRow(std::size_t i)
    {
        const double y = m_top + double(i) * cellHeight;
        m_drawing.text({m_left - 8, y + cellHeight / 2 + 5}, m_map.rows[i].svg, {.size = 14, .anchor = SvgAnchor::End});
        for (std::size_t j = 0; j < m_map.columns.size(); ++j) {
            const HeatMapCell& cell = m_map.cells[i][j];
            const double share =
                cell.shade.exists() ? std::clamp((*cell.shade - m_map.low) / (m_map.high - m_map.low), 0.0, 1.0) : 0;
            m_drawing.rectangle({x(j), y}, m_cellWidth, cellHeight, shadeOf(share), 1, ChartColours::faint);
            if (m_cellWidth >= narrowestCellWithText && !cell.text.empty())
                m_drawing.text({x(j) + m_cellWidth / 2, y + cellHeight / 2 + 5}, protocols::escapedMarkup(cell.text),
                               {.size = 13, .colour = share > 0.5 ? ChartColours::white : ChartColours::ink});
        }
    }

    const HeatMap& m_map;
    bool m_isNarrow;
    double m_left;
    double m_cellWidth;
    bool m_isCrowded;  ///< column labels slant
    double m_top;      ///< of the first row
    protocols::SvgDrawing m_drawing;
};

}  // namespace

std::string drawn(const HeatMap& map, FigureWidth width) { return HeatMapDrawing(map, width).finished(); }

}  // namespace reports
