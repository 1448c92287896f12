#include "reports/figures/chain_figures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/svg_drawing.h"
#include "reports/analysis/quality_chain.h"
#include "reports/charts/chart_colours.h"
#include "reports/text/condition_label.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using protocols::SvgAnchor;
using protocols::SvgPoint;

/// More questions stand in the table only.
constexpr std::size_t mostChainQuestions = 7;

struct PanelPoint {
    stats::Value value;
    stats::Interval ci95;
};

/// One link of the chain: a point for each rendering.
struct ChainPanel {
    std::string title, unit;
    std::vector<PanelPoint> points;  ///< by row of the chain
    double low = 0, high = 1;
    bool isLogarithmic = false;
    std::optional<double> chance = {};
};

/// The ends of the values and of their intervals; nothing where no value exists.
std::optional<std::pair<double, double>> extentOf(const std::vector<PanelPoint>& points)
{
    std::optional<std::pair<double, double>> extent;
    for (const PanelPoint& point : points)
        for (const stats::Value* value : {&point.value, &point.ci95.low, &point.ci95.high})
            if (value->exists() && std::isfinite(**value)) {
                if (!extent) extent = {**value, **value};
                extent = {std::min(extent->first, **value), std::max(extent->second, **value)};
            }
    return extent;
}

/// A linear axis from 0, or from the least value below it.
ChainPanel linearPanel(const std::string& title, const std::string& unit, std::vector<PanelPoint> points)
{
    ChainPanel panel{title, unit, std::move(points)};
    const auto [least, most] = extentOf(panel.points).value_or(std::pair(0.0, 0.0));
    panel.low = std::min(0.0, least);
    panel.high = most > panel.low ? most + 0.05 * (most - panel.low) : panel.low + 1;
    return panel;
}

/// A logarithmic axis over whole decades. Values that are not positive get no point.
ChainPanel timePanel(std::vector<PanelPoint> points)
{
    ChainPanel panel{"time of the signals", "ms", std::move(points)};
    double least = 1e300, most = 0;
    for (PanelPoint& point : panel.points) {
        if (!(point.value.orElse(0) > 0)) point = {};
        if (!(point.ci95.low.orElse(0) > 0)) point.ci95 = {};
        for (const stats::Value& value : {point.value, point.ci95.low, point.ci95.high})
            if (value.exists()) least = std::min(least, *value), most = std::max(most, *value);
    }
    panel.isLogarithmic = true;
    panel.low = most > 0 ? std::floor(std::log10(least)) : 0;
    panel.high = most > 0 ? std::max(std::ceil(std::log10(most)), panel.low + 1) : 1;
    return panel;
}

/// The relief's error where the rendering has a relief, else that of its friction.
PanelPoint errorOf(const RenderingPrice& price)
{
    const PriceFact& relief = price[PriceMeasure::ReliefError];
    const PriceFact& fact = relief.value.exists() ? relief : price[PriceMeasure::FrictionError];
    return {fact.value, fact.ci95};
}

std::vector<ChainPanel> panelsOf(const QualityChain& chain)
{
    const auto pointsOf = [&](const auto& pointOf) {
        std::vector<PanelPoint> points;
        for (const ChainRow& row : chain.rows) points.push_back(pointOf(row));
        return points;
    };
    const auto factOf = [](PriceMeasure measure) {
        return [measure](const ChainRow& row) { return PanelPoint{row.price[measure].value, row.price[measure].ci95}; };
    };
    std::vector<ChainPanel> panels{
        timePanel(pointsOf(factOf(PriceMeasure::Milliseconds))),
        linearPanel("error of the signal", "%", pointsOf([](const ChainRow& row) { return errorOf(row.price); })),
        linearPanel("difference under the finger", "JND", pointsOf(factOf(PriceMeasure::FeltDifference)))};
    for (std::size_t q = 0; q < std::min(chain.questions.size(), mostChainQuestions); ++q) {
        const ChainQuestion& question = chain.questions[q];
        ChainPanel panel{question.id + (question.isChoice ? ": matches" : ": rating"),
                         question.isChoice ? "share correct" : "scale points", pointsOf([q](const ChainRow& row) {
                             return PanelPoint{row.answers[q].value, row.answers[q].ci95};
                         }),
                         question.low, question.high};
        panel.chance = question.chance;
        panels.push_back(std::move(panel));
    }
    const auto bits = pointsOf([](const ChainRow& row) { return PanelPoint{row.bitsPerSecond, row.bitsPerSecondCi95}; });
    if (extentOf(bits)) panels.push_back(linearPanel("information", "bits per second", bits));
    return panels;
}

/// What the dashed lines are, and the conditions that they do not hold for.
std::string chainChanceText(const QualityChain& chain)
{
    const auto shown = std::span(chain.questions).first(std::min(chain.questions.size(), mostChainQuestions));
    const bool hasLine = std::ranges::any_of(shown, [](const ChainQuestion& one) { return one.chance.has_value(); });
    std::string text = hasLine ? ". Dashed line: chance." : ".";
    for (const ChainQuestion& one : shown)
        if (!one.untested.empty())
            text += " " + one.id + " is not tested against chance under " + listed(one.untested) +
                    ": the pairs were not half the same there.";
    return text;
}

/// Panels side by side in lines of three, so that the labels can be read on a phone. Every line repeats the labels of the rows.
class ChainPlot {
public:
    ChainPlot(const QualityChain& chain, const std::vector<ChainPanel>& panels, const std::string& title,
              const std::string& description, FigureWidth width)
        : m_chain(chain),
          m_panels(panels),
          m_across(width == FigureWidth::OneColumn ? 2 : 3),
          m_labelWidth(labelWidthOf(chain)),
          m_drawing(m_labelWidth + static_cast<double>(m_across) * panelStep, static_cast<double>(lines()) * lineHeight(), title,
                    description)
    {
    }

    std::string drawn()
    {
        for (std::size_t line = 0; line < lines(); ++line) drawRowLabels(topOf(line));
        for (std::size_t k = 0; k < m_panels.size(); ++k)
            drawPanel(m_panels[k], m_labelWidth + static_cast<double>(k % m_across) * panelStep, topOf(k / m_across));
        return m_drawing.finished();
    }

private:
    static constexpr double panelWidth = 170, panelStep = 200, rowHeight = 26, headHeight = 44, footHeight = 46;  // px

    std::size_t lines() const { return (m_panels.size() + m_across - 1) / m_across; }

    static double labelWidthOf(const QualityChain& chain)
    {
        double longest = 0;
        for (const ChainRow& row : chain.rows) longest = std::max(longest, labelLength(row.price.condition));
        return 30 + 8 * longest;
    }

    double plotHeight() const { return rowHeight * static_cast<double>(m_chain.rows.size()); }
    double lineHeight() const { return headHeight + plotHeight() + footHeight; }
    double topOf(std::size_t line) const { return static_cast<double>(line) * lineHeight() + headHeight; }
    static double y(double top, std::size_t row) { return top + (static_cast<double>(row) + 0.5) * rowHeight; }

    /// Renderings of one row stand together.
    bool beginsGroup(std::size_t row) const { return row > 0 && m_chain.rows[row].price.row != m_chain.rows[row - 1].price.row; }

    void drawRowLabels(double top)
    {
        for (std::size_t row = 0; row < m_chain.rows.size(); ++row)
            m_drawing.text({m_labelWidth - 12, y(top, row) + 5}, svgLabel(m_chain.rows[row].price.condition),
                           {.size = 14, .anchor = SvgAnchor::End});
    }

    void drawPanel(const ChainPanel& panel, double left, double top)
    {
        const double bottom = top + plotHeight(), middle = left + panelWidth / 2;
        m_drawing.text({middle, top - 14}, protocols::escapedMarkup(panel.title), {.size = 14, .bold = true});
        for (std::size_t row = 0; row < m_chain.rows.size(); ++row)
            if (beginsGroup(row))
                m_drawing.line({left, y(top, row) - rowHeight / 2}, {left + panelWidth, y(top, row) - rowHeight / 2},
                               ChartColours::faint, 1);
        drawAxis(panel, left, top, bottom);
        m_drawing.text({middle, bottom + 38}, protocols::escapedMarkup(panel.unit), {.size = 13});
        for (std::size_t row = 0; row < m_chain.rows.size(); ++row) drawPoint(panel, panel.points[row], left, y(top, row));
    }

    void drawAxis(const ChainPanel& panel, double left, double top, double bottom)
    {
        m_drawing.line({left, bottom}, {left + panelWidth, bottom}, ChartColours::ink, 1.5);
        if (panel.chance) {
            const double at = x(panel, *panel.chance, left);
            m_drawing.line({at, top}, {at, bottom}, ChartColours::ink, 1.2, "6 4");
        }
        for (const double tick : ticksOf(panel)) {
            const double at = left + (tick - panel.low) / (panel.high - panel.low) * panelWidth;
            m_drawing.line({at, bottom}, {at, bottom + 5}, ChartColours::ink, 1.2);
            m_drawing.text({at, bottom + 20}, tickText(panel, tick), {.size = 12});
        }
    }

    /// In units of the axis: decades of a logarithmic one.
    static std::vector<double> ticksOf(const ChainPanel& panel)
    {
        const double length = panel.high - panel.low;
        const double raw = length / 3.5, power = std::pow(10.0, std::floor(std::log10(raw)));
        double step = 10 * power;
        for (const double factor : {5.0, 2.0, 1.0})
            if (raw <= factor * power * 1.0001) step = factor * power;
        if (panel.isLogarithmic) step = std::max(1.0, std::round(step));
        return protocols::multiplesBetween(panel.low, panel.high, step);
    }

    static std::string tickText(const ChainPanel& panel, double tick)
    {
        const double value = panel.isLogarithmic ? std::pow(10.0, tick) : tick;
        return protocols::shortest(std::round(value * 1e6) / 1e6 + 0.0);
    }

    static double x(const ChainPanel& panel, double value, double left)
    {
        const double place = panel.isLogarithmic ? std::log10(value) : value;
        return left + (std::clamp(place, panel.low, panel.high) - panel.low) / (panel.high - panel.low) * panelWidth;
    }

    void drawPoint(const ChainPanel& panel, const PanelPoint& point, double left, double at)
    {
        if (!point.value.exists()) return;
        if (point.ci95.low.exists() && point.ci95.high.exists()) {
            const double low = x(panel, *point.ci95.low, left), high = x(panel, *point.ci95.high, left);
            m_drawing.line({low, at}, {high, at}, ChartColours::ink, 1.6);
            for (const double end : {low, high}) m_drawing.line({end, at - 4}, {end, at + 4}, ChartColours::ink, 1.6);
        }
        m_drawing.circle({x(panel, *point.value, left), at}, 4.5, ChartColours::ink, ChartColours::white);
    }

    const QualityChain& m_chain;
    const std::vector<ChainPanel>& m_panels;
    std::size_t m_across;  ///< number of panels in a line
    double m_labelWidth;
    protocols::SvgDrawing m_drawing;
};

}  // namespace

std::vector<Figure> chainFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    const QualityChain chain = qualityChain(analysis);
    if (chain.rows.empty()) return {};
    const std::vector<ChainPanel> panels = panelsOf(chain);
    const std::string intervals = answerIntervalsText(chain);
    Figure figure{
        .name = "chain",
        .caption = stampedCaption(
            analysis.data,
            "Speed against accuracy, from milliseconds to people. Upper panels, over fabrics: median time of the signals "
            "of one image; error of the signal and difference under a simulated finger, both from the accurate rendering "
            "of the same condition. Other panels: participants' answers. Whiskers: 95 % intervals" +
                (intervals.empty() ? "" : ". " + intervals) + chainChanceText(chain) +
                " A missing point has its reason in the table."),
        .section = PageSection::Chain};
    figure.svg = ChainPlot(chain, panels, "Speed against accuracy, from milliseconds to people", figure.caption, width).drawn();
    return {std::move(figure)};
}

}  // namespace reports
