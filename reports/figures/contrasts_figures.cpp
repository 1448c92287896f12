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
using protocols::SvgText;
using stats::Generalisation;

constexpr std::size_t mostRows = 36;
/// Widths of the whole, of the labels left of the plot and of the verdicts right of it, and the height of the legend; px.
struct ForestSize {
    double whole, labels, verdicts, top;
};

ForestSize sizeFor(FigureWidth width)
{
    return width == FigureWidth::OneColumn ? ForestSize{490, 150, 34, 118} : ForestSize{900, 200, 210, 56};
}

/// A sign in place of the words, where there is no room for them.
const char* signOf(stats::Verdict verdict)
{
    switch (verdict) {
        case stats::Verdict::Different:
            return "\u2260";
        case stats::Verdict::Equivalent:
            return "\u2248";
        case stats::Verdict::DifferentWithinBounds:
            return "\u2260\u2248";
        case stats::Verdict::NotDecided:
            break;
    }
    return "?";
}

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

struct Reach {
    double half = 1;     ///< of the axis, which has 0 in its middle
    bool isCut = false;  ///< some interval goes on beyond it
};

/// Shows every estimate and bound, and intervals up to 20 times as far: with two participants they have no sensible end.
Reach reachOf(const QuestionClaims& claims)
{
    double shown = claims.bounds ? std::max(std::fabs(claims.bounds->first), std::fabs(claims.bounds->second)) : 0, all = 0;
    for (const ContrastFinding& finding : claims.contrasts) {
        const stats::Interval& ci = finding.claim.mean.ci95;
        if (ci.low.exists()) all = std::max({all, std::fabs(*ci.low), std::fabs(*ci.high)});
        if (finding.claim.mean.estimate.exists()) shown = std::max(shown, std::fabs(*finding.claim.mean.estimate));
    }
    const double most = 20 * std::max(shown, 0.05), half = std::max(shown, std::min(all, most));
    return {half > 0 ? half * 1.05 : 1, all > most};
}

/// "a - b".
std::string contrastLabel(const ContrastFinding& finding)
{
    return svgLabel(finding.a) + svgTextAfter(finding.a, " \u2212 ") + svgLabel(finding.b);
}

class ForestPlot {
public:
    ForestPlot(const std::string& question, const QuestionClaims& claims, const std::string& description, FigureWidth width)
        : m_claims(claims),
          m_isNarrow(width == FigureWidth::OneColumn),
          m_size(sizeFor(width)),
          m_reach(reachOf(claims).half),
          m_height(rowHeight * static_cast<double>(claims.contrasts.size() / 2)),
          m_drawing(m_size.whole, m_size.top + m_height + axisHeight, "Contrasts of " + question, description)
    {
    }

    std::string drawn()
    {
        drawZone();
        drawAxis();
        drawLegend();
        for (std::size_t row = 0; 2 * row + 1 < m_claims.contrasts.size(); ++row)
            drawRow(m_claims.contrasts[2 * row], m_claims.contrasts[2 * row + 1],
                    m_size.top + (static_cast<double>(row) + 0.5) * rowHeight);
        return m_drawing.finished();
    }

private:
    double left() const { return m_size.labels; }
    double right() const { return m_size.whole - m_size.verdicts; }
    double x(double value) const
    {
        return (left() + right()) / 2 + std::clamp(value / m_reach, -1.0, 1.0) * (right() - left()) / 2;
    }

    void drawZone()
    {
        if (!m_claims.bounds) return;
        const double from = x(std::max(m_claims.bounds->first, -m_reach)), to = x(std::min(m_claims.bounds->second, m_reach));
        m_drawing.rectangle({from, m_size.top}, to - from, m_height, ChartColours::green, 0.14);
    }

    void drawAxis()
    {
        const double bottom = m_size.top + m_height;
        const double step = tickStep(m_reach);
        for (const double tick : protocols::multiplesBetween(-m_reach, m_reach, step)) {
            m_drawing.line({x(tick), m_size.top}, {x(tick), bottom}, ChartColours::faint, 1);
            m_drawing.text({x(tick), bottom + 18}, typeset(protocols::shortest(std::round(tick * 1e9) / 1e9)),
                           {.size = 13, .colour = ChartColours::grey});
        }
        m_drawing.line({x(0), m_size.top}, {x(0), bottom}, ChartColours::ink, 1.2);
        m_drawing.line({left(), bottom}, {right(), bottom}, ChartColours::ink, 1);
        m_drawing.text({(left() + right()) / 2, bottom + 40},
                       m_claims.bounds ? "difference, scale points" : "difference of the share correct",
                       {.size = 14, .colour = ChartColours::ink});
    }

    void drawLegend()
    {
        const auto entry = [&](protocols::SvgPoint at, const std::string& colour, bool isThick, const std::string& words) {
            m_drawing.line(at, {at.x + 34, at.y}, colour, isThick ? 4 : 2);
            m_drawing.circle({at.x + 17, at.y}, isThick ? 5.5 : 4, colour, ChartColours::white);
            m_drawing.text({at.x + 42, at.y + 5}, words, {.size = 13.5, .anchor = SvgAnchor::Start});
        };
        const double first = m_isNarrow ? 14 : left(), below = m_isNarrow ? 24 : 0;
        entry({first, 20}, ChartColours::vermilion, true, wordsOf(Generalisation::FabricsLikeThese));
        entry({m_isNarrow ? first : first + 190, 20 + below}, ChartColours::blue, false, wordsOf(Generalisation::TheseFabrics));
        const protocols::SvgPoint zone{m_isNarrow ? first + 250 : first + 340, 20};
        if (m_claims.bounds) {
            m_drawing.rectangle({zone.x, zone.y - 8}, 22, 16, ChartColours::green, 0.25);
            m_drawing.text({zone.x + 30, zone.y + 5}, "equivalence", {.size = 13.5, .anchor = SvgAnchor::Start});
        }
        const SvgText remark{.size = 13, .anchor = SvgAnchor::Start, .colour = ChartColours::grey};
        if (!m_isNarrow) return m_drawing.text({right() + 14, 25}, "verdict for fabrics like these", remark);
        m_drawing.text({first, 73}, "verdict for fabrics like these, on the right:", remark);
        m_drawing.text({first, 95}, "\u2260 different, \u2248 equivalent, \u2260\u2248 both, ? not decided", remark);
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
        m_drawing.text({right() + (m_isNarrow ? 6 : 14), y + 5},
                       m_isNarrow ? signOf(alike.claim.verdict) : protocols::escapedMarkup(wordsOf(alike.claim.verdict)),
                       {.size = m_isNarrow ? 16 : 13.5,
                        .anchor = SvgAnchor::Start,
                        .bold = alike.claim.verdict != stats::Verdict::NotDecided});
    }

    const QuestionClaims& m_claims;
    bool m_isNarrow;
    ForestSize m_size;
    double m_reach;
    double m_height;
    SvgDrawing m_drawing;
};

}  // namespace

std::vector<Figure> contrastsFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    std::vector<Figure> figures;
    for (const QuestionAnalysis& question : analysis.questions) {
        const QuestionClaims* claims = claimsOf(question);
        if (claims == nullptr || claims->contrasts.empty() || claims->contrasts.size() > 2 * mostRows) continue;
        const std::string& id = question.question.id;
        Figure figure{
            .name = "contrasts_" + id,
            .caption = stampedCaption(analysis.data,
                                      id +
                                          ": differences of conditions a \u2212 b. Thick lines: 90 % interval. Thin lines: 95 % "
                                          "interval. Neither is corrected for the number of contrasts; the verdicts are." +
                                          (reachOf(*claims).isCut ? " An interval at the edge goes on beyond it." : "")),
            .section = PageSection::Claims,
            .question = id};
        figure.svg = ForestPlot(id, *claims, figure.caption, width).drawn();
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace reports
