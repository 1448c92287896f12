#include "reports/figures/contrasts_figures.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/markup_text.h"
#include "protocols/files/svg_drawing.h"
#include "reports/analysis/claim_words.h"
#include "reports/charts/chart_colours.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"

namespace reports {
namespace {

using protocols::SvgAnchor;
using protocols::SvgDrawing;
using stats::Generalisation;

constexpr std::size_t mostRows = 36;
constexpr double width = 900;       // px
constexpr double labelWidth = 200;  // px, left of the plot
constexpr double verdictWidth = 210;
constexpr double top = 56;
constexpr double rowHeight = 34;
constexpr double axisHeight = 52;

/// A step of 1, 2 or 5 times a power of ten, so that the axis has about six ticks.
double tickStep(double reach)
{
    const double raw = reach / 3;
    const double power = std::pow(10, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (raw <= factor * power) return factor * power;
    return 10 * power;
}

/// Largest distance from 0 of any interval or bound.
double reachOf(const QuestionClaims& claims)
{
    double reach = claims.bounds ? std::max(std::fabs(claims.bounds->first), std::fabs(claims.bounds->second)) : 0;
    for (const ContrastFinding& finding : claims.contrasts) {
        const stats::Interval& ci = finding.claim.mean.ci95;
        if (ci.low.exists()) reach = std::max({reach, std::fabs(*ci.low), std::fabs(*ci.high)});
        if (finding.claim.mean.estimate.exists()) reach = std::max(reach, std::fabs(*finding.claim.mean.estimate));
    }
    return reach > 0 ? reach * 1.05 : 1;
}

/// "a - b"; the sign and b return to the line that a subscript of a has left.
std::string contrastLabel(const ContrastFinding& finding)
{
    const LabelPart last = labelParts(finding.a).back();
    const bool endsLow = !last.subscript.empty() && last.after.empty();
    return svgLabel(finding.a) + "<tspan" + (endsLow ? " dy=\"-4\"" : "") + "> \u2212 </tspan>" + svgLabel(finding.b);
}

class ForestPlot {
public:
    ForestPlot(const std::string& question, const QuestionClaims& claims, const std::string& description)
        : m_claims(claims),
          m_reach(reachOf(claims)),
          m_height(rowHeight * static_cast<double>(claims.contrasts.size() / 2)),
          m_drawing(width, top + m_height + axisHeight, "Contrasts of " + question, description)
    {
    }

    std::string drawn()
    {
        drawZone();
        drawAxis();
        drawLegend();
        for (std::size_t row = 0; 2 * row + 1 < m_claims.contrasts.size(); ++row)
            drawRow(m_claims.contrasts[2 * row], m_claims.contrasts[2 * row + 1],
                    top + (static_cast<double>(row) + 0.5) * rowHeight);
        return m_drawing.finished();
    }

private:
    static double left() { return labelWidth; }
    static double right() { return width - verdictWidth; }
    double x(double value) const { return (left() + right()) / 2 + value / m_reach * (right() - left()) / 2; }

    void drawZone()
    {
        if (!m_claims.bounds) return;
        const double from = x(std::max(m_claims.bounds->first, -m_reach)), to = x(std::min(m_claims.bounds->second, m_reach));
        m_drawing.rectangle({from, top}, to - from, m_height, ChartColours::green, 0.14);
    }

    void drawAxis()
    {
        const double bottom = top + m_height;
        const double step = tickStep(m_reach);
        for (double tick = -std::floor(m_reach / step) * step; tick <= m_reach * 1.0001; tick += step) {
            m_drawing.line({x(tick), top}, {x(tick), bottom}, ChartColours::faint, 1);
            m_drawing.text({x(tick), bottom + 18}, typeset(protocols::shortest(std::round(tick / step) * step)),
                           {.size = 13, .colour = ChartColours::grey});
        }
        m_drawing.line({x(0), top}, {x(0), bottom}, ChartColours::ink, 1.2);
        m_drawing.line({left(), bottom}, {right(), bottom}, ChartColours::ink, 1);
        m_drawing.text({(left() + right()) / 2, bottom + 40},
                       m_claims.bounds ? "difference, scale points" : "difference of the share correct",
                       {.size = 14, .colour = ChartColours::ink});
    }

    void drawLegend()
    {
        const auto entry = [&](double at, const std::string& colour, bool isThick, const std::string& words) {
            m_drawing.line({at, 20}, {at + 34, 20}, colour, isThick ? 4 : 2);
            m_drawing.circle({at + 17, 20}, isThick ? 5.5 : 4, colour, ChartColours::white);
            m_drawing.text({at + 42, 25}, words, {.size = 13.5, .anchor = SvgAnchor::Start});
        };
        entry(left(), ChartColours::vermilion, true, wordsOf(Generalisation::FabricsLikeThese));
        entry(left() + 190, ChartColours::blue, false, wordsOf(Generalisation::TheseFabrics));
        m_drawing.text({right() + 14, 25}, "verdict for fabrics like these",
                       {.size = 13, .anchor = SvgAnchor::Start, .colour = ChartColours::grey});
        if (m_claims.bounds) {
            m_drawing.rectangle({left() + 340, 12}, 22, 16, ChartColours::green, 0.25);
            m_drawing.text({left() + 370, 25}, "equivalence", {.size = 13.5, .anchor = SvgAnchor::Start});
        }
    }

    void drawInterval(const stats::CrossedMean& mean, double y, const std::string& colour, bool isThick)
    {
        if (!mean.estimate.exists()) return;
        if (mean.ci95.low.exists()) {
            m_drawing.line({x(*mean.ci95.low), y}, {x(*mean.ci95.high), y}, colour, isThick ? 1.6 : 1.2);
            m_drawing.line({x(*mean.ci90.low), y}, {x(*mean.ci90.high), y}, colour, isThick ? 4 : 2.6);
        }
        m_drawing.circle({x(*mean.estimate), y}, isThick ? 5.5 : 4, colour, ChartColours::white);
    }

    void drawRow(const ContrastFinding& these, const ContrastFinding& alike, double y)
    {
        m_drawing.text({left() - 14, y + 5}, contrastLabel(alike), {.size = 14, .anchor = SvgAnchor::End, .bold = alike.primary});
        drawInterval(alike.claim.mean, y - 5, ChartColours::vermilion, true);
        drawInterval(these.claim.mean, y + 6, ChartColours::blue, false);
        m_drawing.text({right() + 14, y + 5}, protocols::escapedMarkup(wordsOf(alike.claim.verdict)),
                       {.size = 13.5, .anchor = SvgAnchor::Start, .bold = alike.claim.verdict != stats::Verdict::NotDecided});
    }

    const QuestionClaims& m_claims;
    double m_reach;
    double m_height;
    SvgDrawing m_drawing;
};

}  // namespace

std::vector<Figure> contrastsFigures(const StudyAnalysis& analysis)
{
    std::vector<Figure> figures;
    for (const QuestionAnalysis& question : analysis.questions) {
        const QuestionClaims* claims = claimsOf(question);
        if (claims == nullptr || claims->contrasts.empty() || claims->contrasts.size() > 2 * mostRows) continue;
        const std::string& id = question.question.id;
        Figure figure{
            .name = "contrasts_" + id,
            .caption = stampedCaption(analysis.data,
                                      id + ": differences of conditions a \u2212 b. Thick lines: 90 % interval. Thin lines: 95 % "
                                           "interval. Neither is corrected for the number of contrasts; the verdicts are."),
            .section = PageSection::Claims,
            .question = id};
        figure.svg = ForestPlot(id, *claims, figure.caption).drawn();
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace reports
