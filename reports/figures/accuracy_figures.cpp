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
    AccuracyPlot(const AccuracyBySpeed& accuracy, int alternatives, const std::string& title, const std::string& description)
        : m_accuracy(accuracy),
          m_alternatives(alternatives),
          m_longest(longestTime(accuracy)),
          m_drawing(width, height, title, description)
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
    static constexpr double width = 900, height = 420;  // px
    static constexpr double left = 76, right = 860, top = 50, bottom = 350;

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

    double x(double seconds) const { return left + seconds / m_longest * (right - left); }
    static double y(double share) { return bottom - share * (bottom - top); }

    void drawAxes()
    {
        for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            m_drawing.line({left, y(share)}, {right, y(share)}, ChartColours::faint, 1);
            m_drawing.text({left - 10, y(share) + 5}, protocols::shortest(share), {.anchor = SvgAnchor::End});
        }
        const double step = secondsStep(m_longest);
        for (int tick = 0; tick * step <= m_longest * 1.0001; ++tick) {
            m_drawing.line({x(tick * step), bottom}, {x(tick * step), bottom + 5}, ChartColours::ink, 1.5);
            m_drawing.text({x(tick * step), bottom + 24}, protocols::shortest(std::round(tick * step * 1e6) / 1e6), {.size = 14});
        }
        m_drawing.line({left, bottom}, {right, bottom}, ChartColours::ink, 1.5);
        m_drawing.line({left, top}, {left, bottom}, ChartColours::ink, 1.5);
        m_drawing.text({left - 56, (top + bottom) / 2}, "share correct", {.size = 15, .rotation = -90});
        m_drawing.text({(left + right) / 2, bottom + 54}, "response time, s", {.size = 15});
        const double chance = 1.0 / m_alternatives;
        m_drawing.line({left, y(chance)}, {right, y(chance)}, ChartColours::ink, 1.4, "7 5");
    }

    void drawLegend()
    {
        m_drawing.circle({left + 8, 20}, 6, ChartColours::blue, ChartColours::white);
        m_drawing.text({left + 22, 25}, "mean of participants, 95 % interval", {.size = 14, .anchor = SvgAnchor::Start});
        if (m_accuracy.participants.size() <= mostThinLines) {
            m_drawing.line({left + 310, 20}, {left + 340, 20}, ChartColours::slate, 1);
            m_drawing.text({left + 348, 25}, "one participant", {.size = 14, .anchor = SvgAnchor::Start});
        }
        m_drawing.line({left + 500, 20}, {left + 530, 20}, ChartColours::ink, 1.4, "7 5");
        m_drawing.text({left + 538, 25}, "chance, 1/" + std::to_string(m_alternatives), {.size = 14, .anchor = SvgAnchor::Start});
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
    int m_alternatives;
    double m_longest;
    protocols::SvgDrawing m_drawing;
};

}  // namespace

std::vector<Figure> accuracyFigures(const StudyAnalysis& analysis)
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
                                             "Whiskers: 95 % interval over participants, for these fabrics."),
                      .section = PageSection::Speed,
                      .question = question.id()};
        figure.svg = AccuracyPlot(accuracy, question.findings.alternatives, question.id() + ": share correct by response time",
                                  figure.caption)
                         .drawn();
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace reports
