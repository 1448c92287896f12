#include "reports/figures/ratings_figures.h"

#include <algorithm>

#include "protocols/files/markup_text.h"
#include "reports/charts/chart_colours.h"
#include "reports/charts/plot_frame.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using RatingQuestion = AnalysedQuestion<RatingAnalysis>;

constexpr double legendRoom = 480;  ///< px, beside the remark on the right
constexpr double narrowPlot = 330;  ///< px; wider where there are many conditions

double legendWidth(const std::string& question) { return 52 + 9 * static_cast<double>(question.size()); }

/// Neighbouring questions of one scale whose names fit into the legend.
std::vector<std::vector<RatingQuestion>> figureGroups(const StudyAnalysis& analysis)
{
    std::vector<std::vector<RatingQuestion>> groups;
    double used = 0;
    for (const RatingQuestion& question : questionsWith<RatingAnalysis>(analysis)) {
        const double needed = legendWidth(question.id());
        if (groups.empty() || groups.back().front().findings.scale != question.findings.scale || used + needed > legendRoom) {
            groups.emplace_back();
            used = 0;
        }
        groups.back().push_back(question);
        used += needed;
    }
    return groups;
}

/// Circle, square, diamond, triangle.
void drawMarker(protocols::SvgDrawing& drawing, std::size_t k, protocols::SvgPoint at)
{
    const std::string& colour = seriesColour(k);
    constexpr double r = 6;
    switch (k % 4) {
        case 0:
            drawing.circle(at, r, colour, ChartColours::white);
            break;
        case 1:
            drawing.rectangle({at.x - r + 0.5, at.y - r + 0.5}, 2 * r - 1, 2 * r - 1, colour, 1, ChartColours::white);
            break;
        case 2:
            drawing.polygon({{at.x, at.y - r - 1.5}, {at.x + r + 1.5, at.y}, {at.x, at.y + r + 1.5}, {at.x - r - 1.5, at.y}},
                            colour, ChartColours::white);
            break;
        case 3:
            drawing.polygon({{at.x, at.y - r - 1}, {at.x + r, at.y + r - 1}, {at.x - r, at.y + r - 1}}, colour,
                            ChartColours::white);
            break;
        default:
            break;
    }
}

/// Lines above the plot; the remark stands in one of its own where the figure is narrow.
int legendRows(const std::vector<RatingQuestion>& questions, FigureWidth width)
{
    if (width == FigureWidth::TwoColumns) return 1;
    int rows = 1;
    double x = 0;
    for (const RatingQuestion& question : questions) {
        const double needed = legendWidth(question.id());
        if (x > 0 && x + needed > narrowPlot) {
            ++rows;
            x = 0;
        }
        x += needed;
    }
    return rows + 1;
}

void drawLegend(PlotFrame& plot, const std::vector<RatingQuestion>& questions)
{
    double x = plot.left();
    int row = 0;
    for (std::size_t k = 0; k < questions.size(); ++k) {
        if (plot.isNarrow() && k > 0 && x + legendWidth(questions[k].id()) > plot.left() + narrowPlot) {
            x = plot.left();
            ++row;
        }
        drawMarker(plot.drawing(), k, {x + 8, PlotFrame::legendY(row)});
        plot.drawLegendText(x + 22, protocols::SvgAnchor::Start, protocols::escapedMarkup(questions[k].id()), row);
        x += legendWidth(questions[k].id());
    }
    plot.drawRemark("mean, with 95 % interval over participants");
}

/// The end of a floor or a ceiling, named in the right margin.
struct LineEnd {
    double y;
    std::string name, colour;
};

/// Names at equal heights would cover one another, so lower ones move down.
void drawLineNames(PlotFrame& plot, std::vector<LineEnd> ends)
{
    constexpr double lineHeight = 15, gap = 6;
    std::ranges::sort(ends, {}, &LineEnd::y);
    double free = 0;
    for (const LineEnd& end : ends) {
        const double y = std::max(end.y, free);
        plot.drawing().text({plot.rightEdge() + gap, y + 4}, protocols::escapedMarkup(end.name),
                            {.size = 13, .anchor = protocols::SvgAnchor::Start, .colour = end.colour});
        free = y + lineHeight;
    }
}

/// Floor and ceiling of each question. A long id would not fit into the margin; the colour tells the question, too.
void drawAnchors(PlotFrame& plot, const std::vector<RatingQuestion>& questions, const StudyAnalysis& analysis,
                 const NumberOnScale& scale)
{
    constexpr std::size_t longestId = 4;
    std::vector<LineEnd> ends;
    for (std::size_t k = 0; k < questions.size(); ++k) {
        const QuestionAnchors* anchors = anchorsOf(analysis.anchors, questions[k].id());
        if (anchors == nullptr) continue;
        const bool isNamed = questions.size() > 1 && questions[k].id().size() <= longestId;
        const auto draw = [&](const stats::Value& value, const std::string& name, const std::string& dashes) {
            if (!value.exists() || *value < scale.min || *value > scale.max) return;
            const double y = plot.y(*value);
            plot.drawing().line({plot.left(), y}, {plot.rightEdge(), y}, seriesColour(k), 1.6, dashes);
            ends.push_back({y, name + (isNamed ? " " + questions[k].id() : std::string()), seriesColour(k)});
        };
        if (anchors->floor) draw(anchors->floor->meanOfParticipants, "floor", "2 4");
        if (anchors->ratings) draw(anchors->ratings->meanCeiling.value, "ceiling", "8 5");
    }
    drawLineNames(plot, std::move(ends));
}

/// What the lines of a figure of these questions are; empty without any.
std::string anchorsCaption(const std::vector<RatingQuestion>& questions, const StudyAnalysis& analysis)
{
    const auto hasSome = [&](const auto& isShown) {
        return std::ranges::any_of(questions, [&](const RatingQuestion& question) {
            const QuestionAnchors* anchors = anchorsOf(analysis.anchors, question.id());
            return anchors != nullptr && isShown(*anchors);
        });
    };
    std::string text;
    if (hasSome([](const QuestionAnchors& one) { return one.floor.has_value(); }))
        text += " Dotted lines: floor, the mean rating with another fabric on the tray.";
    if (hasSome([](const QuestionAnchors& one) { return one.ratings && one.ratings->meanCeiling.value.exists(); }))
        text += " Dashed lines: ceiling, the highest mean that the noise of repeated answers allows.";
    return text;
}

void drawMeans(PlotFrame& plot, const std::vector<RatingQuestion>& questions)
{
    const auto n = static_cast<double>(questions.size());
    const double gap = std::min(22.0, plot.slot() * 0.72 / n);
    for (std::size_t i = 0; i < plot.conditions().size(); ++i)
        for (std::size_t k = 0; k < questions.size(); ++k) {
            const ConditionRatings& ratings = questions[k].findings.conditions[i];
            if (!ratings.meanOfParticipants.exists()) continue;
            const double x = plot.centre(i) + (static_cast<double>(k) - (n - 1) / 2) * gap;
            plot.drawErrorBar(x, ratings.ci95, seriesColour(k));
            drawMarker(plot.drawing(), k, {x, plot.y(*ratings.meanOfParticipants)});
        }
}

/// "(Q2 and Q3)", where other questions have a figure of their own.
std::string namesIn(const std::vector<RatingQuestion>& questions)
{
    std::vector<std::string> names;
    for (const RatingQuestion& question : questions) names.push_back(question.id());
    return " (" + listed(names) + ")";
}

}  // namespace

std::vector<Figure> ratingsFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    const auto groups = figureGroups(analysis);
    std::vector<Figure> figures;
    for (const std::vector<RatingQuestion>& questions : groups) {
        Figure figure{.name = figures.empty() ? "ratings" : "ratings_" + std::to_string(figures.size() + 1),
                      .caption = stampedCaption(analysis.data, "Ratings by condition and question" +
                                                                   (groups.size() > 1 ? namesIn(questions) : std::string()) +
                                                                   ": means of the participants' means, with their 95 % "
                                                                   "interval." +
                                                                   anchorsCaption(questions, analysis)),
                      .section = PageSection::Ratings};
        const NumberOnScale& scale = questions.front().findings.scale;
        PlotFrame plot(analysis.data.conditions, scale.min, scale.max, "Ratings by question and condition", figure.caption,
                       {width, legendRows(questions, width)});
        plot.drawFrame("rating");
        drawLegend(plot, questions);
        drawAnchors(plot, questions, analysis, scale);
        drawMeans(plot, questions);
        figure.svg = plot.drawing().finished();
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace reports
