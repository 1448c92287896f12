#include "reports/figures/fabric_figures.h"

#include <numeric>

#include "protocols/files/number_text.h"
#include "reports/charts/heat_map.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"

namespace reports {
namespace {

constexpr std::size_t mostFabrics = 40;

std::vector<HeatMapLabel> labelsOf(const std::vector<std::string>& names)
{
    std::vector<HeatMapLabel> labels;
    for (const std::string& name : names) labels.push_back({svgLabel(name), labelLength(name)});
    return labels;
}

Figure confusionFigure(const StudyAnalysis& analysis, const AnalysedQuestion<ChoiceAnalysis>& question, FigureWidth width)
{
    const std::string& id = question.id();
    Figure figure{.name = "confusion_" + id,
                  .caption = stampedCaption(
                      analysis.data, id + ": which fabric was chosen (columns) when a rendering of another was felt (rows). "
                                          "Numbers: answers over all conditions and participants. Shades: their share of "
                                          "the row. Only fabrics on the tray could be chosen."),
                  .section = PageSection::Matches,
                  .question = id};
    HeatMap map{.title = id + ": fabrics chosen for each fabric",
                .description = figure.caption,
                .rowTitle = "fabric rendered",
                .columnTitle = "fabric chosen",
                .rows = labelsOf(analysis.data.fabrics),
                .columns = labelsOf(analysis.data.fabrics),
                .cells = {},
                .low = 0,
                .high = 1,
                .lowText = "0 %",
                .highText = "100 % of the answers"};
    for (const std::vector<std::size_t>& row : question.findings.confusion.chosen) {
        const std::size_t all = std::accumulate(row.begin(), row.end(), std::size_t(0));
        map.cells.emplace_back();
        for (const std::size_t count : row)
            map.cells.back().push_back(
                {all > 0 ? stats::Value(double(count) / double(all)) : stats::Value::undefined("no answers"),
                 std::to_string(count)});
    }
    figure.svg = drawn(map, width);
    return figure;
}

Figure ratingsByFabric(const StudyAnalysis& analysis, const AnalysedQuestion<RatingAnalysis>& question, FigureWidth width)
{
    const std::string& id = question.id();
    const NumberOnScale& scale = question.findings.scale;
    Figure figure{
        .name = "by_fabric_" + id,
        .caption = stampedCaption(analysis.data, id + ": mean rating of each fabric (rows) under each condition (columns), "
                                                      "over participants. Dark cells: high ratings."),
        .section = PageSection::Ratings,
        .question = id};
    HeatMap map{.title = id + ": ratings by fabric and condition",
                .description = figure.caption,
                .rowTitle = "fabric",
                .columnTitle = "condition",
                .rows = labelsOf(analysis.data.fabrics),
                .columns = labelsOf(analysis.data.conditions),
                .cells = {},
                .low = scale.min,
                .high = scale.max,
                .lowText = protocols::shortest(scale.min),
                .highText = protocols::shortest(scale.max)};
    for (std::size_t f = 0; f < analysis.data.fabrics.size(); ++f) {
        map.cells.emplace_back();
        for (const ConditionRatings& condition : question.findings.conditions) {
            const stats::Value& mean = condition.byFabric[f];
            map.cells.back().push_back({mean, mean.exists() ? typeset(fixed(*mean, 1)) : ""});
        }
    }
    figure.svg = drawn(map, width);
    return figure;
}

}  // namespace

std::vector<Figure> fabricFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    std::vector<Figure> figures;
    if (analysis.data.fabrics.size() > mostFabrics) return figures;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis))
        if (question.findings.confusion.known) figures.push_back(confusionFigure(analysis, question, width));
    for (const auto& question : questionsWith<RatingAnalysis>(analysis))
        if (question.findings.scale.max > question.findings.scale.min)
            figures.push_back(ratingsByFabric(analysis, question, width));
    return figures;
}

}  // namespace reports
