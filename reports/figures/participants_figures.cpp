#include "reports/figures/participants_figures.h"

#include <algorithm>

#include "protocols/files/svg_drawing.h"
#include "reports/charts/chart_colours.h"
#include "reports/charts/plot_frame.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using RatingQuestion = AnalysedQuestion<RatingAnalysis>;

/// Lines of single participants are drawn up to this number; more are points alone.
constexpr std::size_t mostLines = 30;

void drawParticipants(PlotFrame& plot, const RatingAnalysis& ratings)
{
    const auto count = static_cast<double>(ratings.participants.size());
    const double spread = plot.slot() * 0.36;
    for (std::size_t k = 0; k < ratings.participants.size(); ++k) {
        const double shift = count < 2 ? 0 : (static_cast<double>(k) / (count - 1) - 0.5) * spread;
        std::vector<protocols::SvgPoint> points;
        for (std::size_t i = 0; i < plot.conditions().size(); ++i)
            if (const stats::Value& mean = ratings.participants[k].means[i]; mean.exists())
                points.push_back({plot.centre(i) + shift, plot.y(*mean)});
        if (ratings.participants.size() <= mostLines) plot.drawing().polyline(points, ChartColours::pale, 1);
        for (const protocols::SvgPoint& point : points) plot.drawing().circle(point, 3, ChartColours::slate, ChartColours::white);
    }
}

void drawMeansOfParticipants(PlotFrame& plot, const RatingAnalysis& ratings)
{
    for (std::size_t i = 0; i < plot.conditions().size(); ++i) {
        const ConditionRatings& condition = ratings.conditions[i];
        if (!condition.meanOfParticipants.exists()) continue;
        const double mean = *condition.meanOfParticipants;
        const double x = plot.centre(i) + plot.slot() * 0.3;
        if (condition.withinHalfWidth.exists())
            plot.drawErrorBar(x, {mean - *condition.withinHalfWidth, mean + *condition.withinHalfWidth}, ChartColours::vermilion);
        plot.drawing().circle({x, plot.y(mean)}, 5.5, ChartColours::vermilion, ChartColours::white);
    }
}

/// Names shapes and not colours: the figure is also read in grey.
std::string captionOf(const RatingQuestion& question)
{
    const auto& participants = question.findings.participants;
    const auto people = static_cast<std::size_t>(std::ranges::count_if(participants, [](const ParticipantMeans& one) {
        return std::ranges::any_of(one.means, [](const stats::Value& mean) { return mean.exists(); });
    }));
    const std::string joined = participants.size() <= mostLines ? ", joined by lines" : "";
    return question.id() + ": the mean of each of " + counted(people, "participant") + " under each condition (small points" +
           joined + "). Large points: their mean, with the 95 % within-participant interval (Morey).";
}

}  // namespace

std::vector<Figure> participantsFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    std::vector<Figure> figures;
    for (const RatingQuestion& question : questionsWith<RatingAnalysis>(analysis)) {
        Figure figure{.name = "participants_" + question.id(),
                      .caption = stampedCaption(analysis.data, captionOf(question)),
                      .section = PageSection::Ratings,
                      .question = question.id()};
        const NumberOnScale& scale = question.findings.scale;
        PlotFrame plot(analysis.data.conditions, scale.min, scale.max, question.id() + ": participants by condition",
                       figure.caption, {width, width == FigureWidth::OneColumn ? 2 : 1});
        plot.drawFrame(question.id());
        plot.drawLegendText(plot.left(), protocols::SvgAnchor::Start, "small points: one participant each");
        plot.drawRemark("large points: mean, with within-participant interval");
        drawParticipants(plot, question.findings);
        drawMeansOfParticipants(plot, question.findings);
        figure.svg = plot.drawing().finished();
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace reports
