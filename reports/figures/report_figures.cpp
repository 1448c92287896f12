#include "reports/figures/report_figures.h"

#include <algorithm>
#include <cmath>

#include "reports/charts/svg_drawing.h"
#include "reports/text/condition_label.h"

namespace reports {
namespace {

// Okabe and Ito's colours, which people with any colour blindness can tell apart.
const std::string blue = "#0072B2";
const std::string orange = "#E69F00";
const std::string green = "#009E73";
const std::string vermilion = "#D55E00";
const std::string purple = "#CC79A7";
const std::string black = "#22303a";
const std::string grey = "#5b6770";
const std::string faint = "#dfe4e8";

std::string colourOf(protocols::ConditionGroup group)
{
    switch (group) {
        case protocols::ConditionGroup::Vision:
            return blue;
        case protocols::ConditionGroup::Generated:
            return orange;
        case protocols::ConditionGroup::Measured:
            return green;
    }
    return grey;
}

/// Groups are shown when every condition belongs to one, and nothing is masked.
bool hasGroups(const Analysis& analysis)
{
    const auto& conditions = analysis.data.conditions;
    return !analysis.data.blinded &&
           std::all_of(conditions.begin(), conditions.end(), [](const std::string& one) { return groupOf(one).has_value(); });
}

std::string conditionColour(const std::string& condition, bool isGrouped)
{
    return isGrouped ? colourOf(*groupOf(condition)) : "#56718a";
}

double niceStep(double range)
{
    const double raw = range / 5;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double step : {1.0, 2.0, 2.5, 5.0})
        if (step * power >= raw * 0.999) return step * power;
    return 10 * power;
}

/// Frame, axes, gridlines, condition labels and group bands: what both figures share.
class Plot {
public:
    Plot(const Analysis& analysis, double low, double high, const std::string& title, const std::string& description)
        : m_conditions(conditionsOf(analysis.results)),
          m_blinded(analysis.data.blinded),
          m_hasGroups(hasGroups(analysis)),
          m_low(low),
          m_high(high),
          m_slot(std::max(64.0, 800.0 / std::max<double>(1, static_cast<double>(m_conditions.size())))),
          m_isCrowded(longestLabel() > m_slot - 8),
          m_drawing(left() + plotWidth() + right, top + height + bottom(), title, description)
    {
    }

    const std::vector<std::string>& conditions() const { return m_conditions; }
    SvgDrawing& drawing() { return m_drawing; }
    /// Room for the axis, and for the first of the slanting labels.
    double left() const { return m_isCrowded ? std::max(76.0, longestLabel() * 0.82 - m_slot / 2 + 12) : 76; }
    double slot() const { return m_slot; }
    double centre(std::size_t i) const { return left() + (static_cast<double>(i) + 0.5) * m_slot; }
    double y(double value) const { return top + height * (1 - (value - m_low) / (m_high - m_low)); }
    double rightEdge() const { return left() + plotWidth(); }
    double plotWidth() const { return m_slot * static_cast<double>(m_conditions.size()); }

    void drawFrame(const std::string& axisTitle)
    {
        drawBands();
        const double step = niceStep(m_high - m_low);
        for (double value = std::ceil(m_low / step) * step; value <= m_high + step * 1e-9; value += step) {
            m_drawing.line({left(), y(value)}, {rightEdge(), y(value)}, value == m_low ? black : faint, value == m_low ? 1.5 : 1);
            m_drawing.text({left() - 10, y(value) + 5}, shortest(std::round(value * 1e6) / 1e6),
                           {14, Anchor::End, black, false, 0});
        }
        m_drawing.line({left(), top}, {left(), top + height}, black, 1.5);
        m_drawing.text({left() - 56, top + height / 2}, axisTitle, {15, Anchor::Middle, black, false, -90});
        for (std::size_t i = 0; i < m_conditions.size(); ++i) drawLabel(i);
        m_drawing.text({left() + plotWidth() / 2, top + height + bottom() - 8}, m_blinded ? "masked condition" : "condition",
                       {15, Anchor::Middle, black, false, 0});
    }

    void drawRightAxis(double wholeValue, const std::string& axisTitle)
    {
        for (const int percent : {0, 25, 50, 75, 100}) {
            const double at = y(wholeValue * percent / 100);
            m_drawing.line({rightEdge(), at}, {rightEdge() + 5, at}, black, 1.5);
            m_drawing.text({rightEdge() + 10, at + 5}, std::to_string(percent) + " %", {13, Anchor::Start, grey, false, 0});
        }
        m_drawing.line({rightEdge(), top}, {rightEdge(), top + height}, black, 1.5);
        m_drawing.text({rightEdge() + right - 8, top + height / 2}, axisTitle, {14, Anchor::Middle, grey, false, -90});
    }

    void drawErrorBar(double x, const stats::Interval& interval, const std::string& colour)
    {
        if (!interval.low.exists() || !interval.high.exists()) return;
        const double low = y(std::clamp(*interval.low, m_low, m_high));
        const double high = y(std::clamp(*interval.high, m_low, m_high));
        m_drawing.line({x, low}, {x, high}, colour, 1.8);
        m_drawing.line({x - 5, low}, {x + 5, low}, colour, 1.8);
        m_drawing.line({x - 5, high}, {x + 5, high}, colour, 1.8);
    }

    static constexpr double right = 84;
    static constexpr double top = 62;
    static constexpr double height = 300;

private:
    double longestLabel() const
    {
        double longest = 0;
        for (const std::string& condition : m_conditions) longest = std::max(longest, labelLength(condition) * 9.0);
        return longest;
    }

    double bottom() const { return m_isCrowded ? 56 + std::min(120.0, longestLabel() * 0.62) : 62; }

    void drawLabel(std::size_t i)
    {
        const std::string label = svgLabel(m_conditions[i]);
        if (m_isCrowded)
            m_drawing.text({centre(i) + 6, top + height + 22}, label, {15, Anchor::End, black, false, -35});
        else
            m_drawing.text({centre(i), top + height + 24}, label, {17, Anchor::Middle, black, false, 0});
    }

    /// Neighbouring conditions of one group share a tinted band with its name.
    void drawBands()
    {
        for (std::size_t begin = 0; begin < m_conditions.size() && m_hasGroups;) {
            const auto group = groupOf(m_conditions[begin]);
            std::size_t end = begin + 1;
            while (end < m_conditions.size() && groupOf(m_conditions[end]) == group) ++end;
            if (group) {
                const double x = left() + static_cast<double>(begin) * m_slot;
                const double width = static_cast<double>(end - begin) * m_slot;
                m_drawing.rectangle({x + 2, top - 24}, width - 4, 20, colourOf(*group), 0.22);
                if (width > 9.0 * static_cast<double>(nameOf(*group).size()))
                    m_drawing.text({x + width / 2, top - 9}, nameOf(*group), {14, Anchor::Middle, black, true, 0});
                m_drawing.rectangle({x + 2, top}, width - 4, height, colourOf(*group), 0.05);
            }
            begin = end;
        }
    }

    std::vector<std::string> m_conditions;
    bool m_blinded;
    bool m_hasGroups;
    double m_low;
    double m_high;
    double m_slot;
    bool m_isCrowded;
    SvgDrawing m_drawing;
};

void drawBar(Plot& plot, std::size_t i, const std::string& condition, const Json& part, double participants, bool isGrouped)
{
    const stats::Value matches = valueOf(part, "matches_per_rendering");
    if (!matches.exists()) {
        plot.drawing().text({plot.centre(i), plot.y(0) - 8}, "no data", {13, Anchor::Middle, grey, false, 0});
        return;
    }
    const double width = std::min(54.0, plot.slot() * 0.62);
    const std::string colour = conditionColour(condition, isGrouped);
    plot.drawing().rectangle({plot.centre(i) - width / 2, plot.y(*matches)}, width, plot.y(0) - plot.y(*matches), colour, 0.45,
                             colour, condition + ": " + fixed(*matches, 2));
    stats::Interval ci = intervalOf(part, "ci95");
    if (ci.low.exists()) ci = {*ci.low * participants, *ci.high * participants};
    plot.drawErrorBar(plot.centre(i), ci, black);
    plot.drawing().text({plot.centre(i), plot.y(0) - 8}, fixed(*matches, 1), {15, Anchor::Middle, black, true, 0});
}

/// The sign of the k-th rating question: circle, square, diamond, triangle.
void drawMarker(SvgDrawing& drawing, std::size_t k, SvgPoint at)
{
    const std::vector<std::string> colours{blue, vermilion, green, purple, black};
    const std::string& colour = colours[k % colours.size()];
    constexpr double r = 6;
    switch (k % 4) {
        case 0:
            drawing.circle(at, r, colour, "#ffffff");
            break;
        case 1:
            drawing.rectangle({at.x - r + 0.5, at.y - r + 0.5}, 2 * r - 1, 2 * r - 1, colour, 1, "#ffffff");
            break;
        case 2:
            drawing.polygon({{at.x, at.y - r - 1.5}, {at.x + r + 1.5, at.y}, {at.x, at.y + r + 1.5}, {at.x - r - 1.5, at.y}},
                            colour, "#ffffff");
            break;
        case 3:
            drawing.polygon({{at.x, at.y - r - 1}, {at.x + r, at.y + r - 1}, {at.x - r, at.y + r - 1}}, colour, "#ffffff");
            break;
        default:
            break;
    }
}

std::string markerColour(std::size_t k)
{
    const std::vector<std::string> colours{blue, vermilion, green, purple, black};
    return colours[k % colours.size()];
}

void drawLegend(Plot& plot, const std::vector<std::string>& questions)
{
    double x = plot.left();
    for (std::size_t k = 0; k < questions.size(); ++k) {
        drawMarker(plot.drawing(), k, {x + 8, 17});
        plot.drawing().text({x + 22, 22}, escapedHtml(questions[k]), {15, Anchor::Start, black, false, 0});
        x += 52 + 9 * static_cast<double>(questions[k].size());
    }
    plot.drawing().text({plot.rightEdge(), 22}, "mean, with 95 % interval over participants", {13, Anchor::End, grey, false, 0});
}

std::string stamped(const Analysis& analysis, const std::string& caption)
{
    return caption + (analysis.data.simulated ? " SIMULATED participants." : "") +
           (analysis.data.blinded ? " Blinded: conditions are masked." : "");
}

}  // namespace

Figure matchesFigure(const Analysis& analysis, const std::string& question)
{
    const auto participants = static_cast<double>(std::max<std::size_t>(1, analysis.data.participants.size()));
    const double chance = participants / analysis.data.alternativesOf(question);
    const std::string people = std::to_string(analysis.data.participants.size());
    Figure figure{"matches_" + question,
                  stamped(analysis, question + ": correct matches per rendering, of " + people +
                                        " participants. Bars: share correct times the number of participants; whiskers: Wilson's "
                                        "95 % interval over trials; dashed: chance, 1/" +
                                        std::to_string(analysis.data.alternativesOf(question)) + "."),
                  {}};
    Plot plot(analysis, 0, participants, question + ": matches per rendering by condition", figure.caption);
    plot.drawFrame("matches per rendering (of " + people + ")");
    plot.drawRightAxis(participants, "share correct");
    for (std::size_t i = 0; i < plot.conditions().size(); ++i)
        drawBar(plot, i, plot.conditions()[i], analysis.results[question][plot.conditions()[i]], participants,
                hasGroups(analysis));
    plot.drawing().line({plot.left(), plot.y(chance)}, {plot.rightEdge(), plot.y(chance)}, vermilion, 2, "7 5");
    plot.drawing().line({plot.left(), 17}, {plot.left() + 34, 17}, vermilion, 2, "7 5");
    plot.drawing().text({plot.left() + 42, 22}, "chance: " + fixed(chance, 1) + " of " + people,
                        {15, Anchor::Start, black, false, 0});
    plot.drawing().text({plot.rightEdge(), 22}, "whiskers: 95 % interval (Wilson)", {13, Anchor::End, grey, false, 0});
    figure.svg = plot.drawing().finished();
    return figure;
}

Figure ratingsFigure(const Analysis& analysis)
{
    const std::vector<std::string> questions = ratingQuestions(analysis.results);
    Figure figure{
        "ratings",
        stamped(analysis,
                "Ratings by condition and question: means over ratings; whiskers: 95 % interval of the mean over participants."),
        {}};
    Plot plot(analysis, analysis.data.scaleMin, analysis.data.scaleMax, "Ratings by question and condition", figure.caption);
    plot.drawFrame("rating");
    drawLegend(plot, questions);
    const double gap = std::min(22.0, plot.slot() * 0.72 / std::max<double>(1, static_cast<double>(questions.size())));
    for (std::size_t i = 0; i < plot.conditions().size(); ++i)
        for (std::size_t k = 0; k < questions.size(); ++k) {
            const Json& part = analysis.results[questions[k]][plot.conditions()[i]];
            const double x = plot.centre(i) + (static_cast<double>(k) - static_cast<double>(questions.size() - 1) / 2) * gap;
            const stats::Value mean = valueOf(part, "mean");
            if (!mean.exists()) continue;
            plot.drawErrorBar(x, intervalOf(part, "ci95"), markerColour(k));
            drawMarker(plot.drawing(), k, {x, plot.y(*mean)});
        }
    figure.svg = plot.drawing().finished();
    return figure;
}

std::vector<Figure> allFigures(const Analysis& analysis)
{
    std::vector<Figure> figures;
    for (const std::string& question : choiceQuestions(analysis.results)) figures.push_back(matchesFigure(analysis, question));
    if (!ratingQuestions(analysis.results).empty()) figures.push_back(ratingsFigure(analysis));
    return figures;
}

}  // namespace reports
