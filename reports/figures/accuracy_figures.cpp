#include "reports/figures/accuracy_figures.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/number_text.h"
#include "protocols/files/svg_drawing.h"
#include "reports/charts/chart_colours.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using protocols::SvgAnchor;
using protocols::SvgPoint;

/// Lines of single participants are drawn up to this number.
constexpr std::size_t mostThinLines = 30;

/// A step of 1, 2 or 5 times a power of ten that divides the length into at most eight parts.
double secondsStep(double length)
{
    const double raw = length / 8;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (raw <= factor * power * 1.0001) return factor * power;
    return 10 * power;
}

class AccuracyPlot {
public:
    AccuracyPlot(const AccuracyBySpeed& accuracy, int alternatives, const std::string& title, const std::string& description,
                 FigureWidth figureWidth)
        : m_accuracy(accuracy),
          m_alternatives(alternatives),
          m_isNarrow(figureWidth == FigureWidth::OneColumn),
          m_right(m_isNarrow ? 470 : 860),
          m_top(m_isNarrow ? 94 : 50),
          m_bottom(m_top + 300),
          m_longest(longestTime(accuracy)),
          m_drawing(m_isNarrow ? 490 : 900, m_top + 370, title, description)
    {
    }

    std::string drawn()
    {
        drawAxes();
        drawLegend();
        if (m_accuracy.participants.size() <= mostThinLines)
            for (const ParticipantSpeed& one : m_accuracy.participants) drawParticipant(one);
        drawMeans();
        return m_drawing.finished();
    }

private:
    static constexpr double left = 76;  // px

    /// End of the axis of times, s.
    static double longestTime(const AccuracyBySpeed& accuracy)
    {
        double longest = 0;
        for (const SpeedBin& bin : accuracy.bins) longest = std::max(longest, bin.meanSeconds.orElse(0));
        if (accuracy.participants.size() <= mostThinLines)
            for (const ParticipantSpeed& one : accuracy.participants)
                for (const stats::Value& seconds : one.meanSeconds) longest = std::max(longest, seconds.orElse(0));
        return longest > 0 ? longest * 1.05 : 1;
    }

    double x(double seconds) const { return left + seconds / m_longest * (m_right - left); }
    double y(double share) const { return m_bottom - share * (m_bottom - m_top); }

    void drawAxes()
    {
        for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            m_drawing.line({left, y(share)}, {m_right, y(share)}, ChartColours::faint, 1);
            m_drawing.text({left - 10, y(share) + 5}, protocols::shortest(share), {.anchor = SvgAnchor::End});
        }
        const double step = secondsStep(m_longest);
        for (const double tick : protocols::multiplesBetween(0, m_longest * 1.0001, step)) {
            m_drawing.line({x(tick), m_bottom}, {x(tick), m_bottom + 5}, ChartColours::ink, 1.5);
            m_drawing.text({x(tick), m_bottom + 24}, protocols::shortest(std::round(tick * 1e6) / 1e6), {.size = 14});
        }
        m_drawing.line({left, m_bottom}, {m_right, m_bottom}, ChartColours::ink, 1.5);
        m_drawing.line({left, m_top}, {left, m_bottom}, ChartColours::ink, 1.5);
        m_drawing.text({left - 56, (m_top + m_bottom) / 2}, "share correct", {.size = 15, .rotation = -90});
        m_drawing.text({(left + m_right) / 2, m_bottom + 54}, "response time, s", {.size = 15});
        if (m_alternatives < 1) return;
        const double chance = 1.0 / m_alternatives;
        m_drawing.line({left, y(chance)}, {m_right, y(chance)}, ChartColours::ink, 1.4, "7 5");
    }

    void drawLegend()
    {
        const auto place = [&](double wideX, int narrowRow) {
            return m_isNarrow ? SvgPoint{left, 20 + 22.0 * narrowRow} : SvgPoint{left + wideX, 20};
        };
        const auto words = [&](SvgPoint at, const std::string& text) {
            m_drawing.text({at.x + 38, at.y + 5}, text, {.size = 14, .anchor = SvgAnchor::Start});
        };
        const auto stroke = [&](SvgPoint at, const std::string& colour, double thick, const char* dashes,
                                const std::string& text) {
            m_drawing.line(at, {at.x + 30, at.y}, colour, thick, dashes);
            words(at, text);
        };
        const SvgPoint mean = place(0, 0);
        m_drawing.circle({mean.x + 15, mean.y}, 6, ChartColours::blue, ChartColours::white);
        words(mean, "mean of participants, 95 % interval");
        if (m_accuracy.participants.size() <= mostThinLines) stroke(place(310, 1), ChartColours::slate, 1, "", "one participant");
        if (m_alternatives > 0)
            stroke(place(500, 2), ChartColours::ink, 1.4, "7 5", "chance, 1/" + std::to_string(m_alternatives));
    }

    void drawParticipant(const ParticipantSpeed& one)
    {
        std::vector<SvgPoint> points;
        for (std::size_t i = 0; i < one.shares.size(); ++i)
            if (one.shares[i].exists()) points.push_back({x(*one.meanSeconds[i]), y(*one.shares[i])});
        m_drawing.polyline(points, ChartColours::slate, 0.6);
    }

    void drawMeans()
    {
        std::vector<SvgPoint> points;
        for (const SpeedBin& bin : m_accuracy.bins)
            if (bin.share.exists()) points.push_back({x(*bin.meanSeconds), y(*bin.share)});
        m_drawing.polyline(points, ChartColours::blue, 2.4);
        for (const SpeedBin& bin : m_accuracy.bins) {
            if (!bin.share.exists()) continue;
            const double at = x(*bin.meanSeconds);
            if (bin.ci95.low.exists()) {
                m_drawing.line({at, y(*bin.ci95.low)}, {at, y(*bin.ci95.high)}, ChartColours::blue, 2);
                for (const double end : {y(*bin.ci95.low), y(*bin.ci95.high)})
                    m_drawing.line({at - 5, end}, {at + 5, end}, ChartColours::blue, 2);
            }
            m_drawing.circle({at, y(*bin.share)}, 6, ChartColours::blue, ChartColours::white);
        }
    }

    const AccuracyBySpeed& m_accuracy;
    int m_alternatives;  ///< 0: there is no line of chance
    bool m_isNarrow;
    double m_right, m_top, m_bottom;  ///< of the plot, px
    double m_longest;
    protocols::SvgDrawing m_drawing;
};

}  // namespace

std::vector<Figure> accuracyFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    std::vector<Figure> figures;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) {
        const AccuracyBySpeed& accuracy = question.findings.accuracyBySpeed;
        if (accuracy.bins.empty()) continue;
        Figure figure{.name = "conditional_accuracy_" + question.id(),
                      .caption = stampedCaption(
                          analysis.data, question.id() + ": share correct by response time, of " +
                                             counted(accuracy.participants.size(), "participant") +
                                             ". Points: quarters of each participant's own times, all conditions together. "
                                             "Whiskers: 95 % interval over participants, for these fabrics." +
                                             untestedText(analysis.data, question.findings)),
                      .section = PageSection::Speed,
                      .question = question.id()};
        figure.svg = AccuracyPlot(accuracy, shownChance(question.findings), question.id() + ": share correct by response time",
                                  figure.caption, width)
                         .drawn();
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace reports
