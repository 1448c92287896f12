#include "reports/figures/speed_figures.h"

#include <algorithm>
#include <utility>

#include "reports/charts/speed_plot.h"

namespace reports {
namespace {

/// More points than these hide each other.
constexpr std::size_t mostPoints = 40;

SpeedPoint pointOf(const std::string& name, const ConditionSpeed& speed)
{
    return {name, speed.medianSeconds, speed.share, speed.medianSecondsCi95, speed.shareCi95};
}

SpeedLine lineOf(const std::string& name, const AccuracyBySpeed& accuracy)
{
    SpeedLine line{name, {}};
    for (const SpeedBin& bin : accuracy.bins) line.points.push_back({"", bin.meanSeconds, bin.share, {}, bin.ci95});
    return line;
}

bool anyTimes(const std::vector<SpeedPoint>& points)
{
    return std::ranges::any_of(points, [](const SpeedPoint& point) { return point.time.exists() && point.share.exists(); });
}

Figure conditionsFigure(const StudyAnalysis& analysis, const AnalysedQuestion<ChoiceAnalysis>& question, FigureWidth width)
{
    SpeedPlot plot{.title = question.id() + ": speed against accuracy", .alternatives = shownChance(question.findings)};
    for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c)
        plot.points.push_back(pointOf(analysis.data.conditions[c], question.findings.speed.conditions[c]));
    if (!question.findings.accuracyBySpeed.bins.empty())
        plot.lines.push_back(lineOf("all conditions by time", question.findings.accuracyBySpeed));
    const std::string line = plot.lines.empty()
                                 ? ""
                                 : " Line: share correct by response time, all conditions together (quarters of each "
                                   "participant's own times).";
    Figure figure{.name = "speed_accuracy_" + question.id(),
                  .caption = stampedCaption(
                      analysis.data, question.id() +
                                         ": speed against accuracy. Numbered points: median response time and share correct of a "
                                         "condition. Bars: 95 % intervals over participants, for these fabrics." +
                                         line + untestedText(analysis.data, question.findings)),
                  .section = PageSection::Speed,
                  .question = question.id()};
    plot.description = figure.caption;
    if (anyTimes(plot.points)) figure.svg = drawn(plot, width);
    return figure;
}

Figure instructionsFigure(const StudyAnalysis& analysis, const AnalysedQuestion<ChoiceAnalysis>& question, FigureWidth width)
{
    SpeedPlot plot{.title = question.id() + ": speed against accuracy by instruction",
                   .alternatives = shownChance(question.findings),
                   .signs = PointSigns::Shapes};
    for (const InstructedSpeed& under : question.findings.instructions.instructions) {
        plot.points.push_back(pointOf(under.instruction.id, under.speed));
        if (!under.accuracy.bins.empty()) plot.lines.push_back(lineOf(under.instruction.id + " by time", under.accuracy));
        if (under.instruction.deadlineSeconds) plot.deadlines.push_back(*under.instruction.deadlineSeconds);
    }
    const std::string lines = plot.lines.empty()
                                  ? ""
                                  : " Lines: share correct by response time under one instruction (quarters of each "
                                    "participant's own times).";
    Figure figure{.name = "instructions_" + question.id(),
                  .caption = stampedCaption(
                      analysis.data,
                      question.id() +
                          ": speed against accuracy by instruction, all conditions together. Points: median response time and "
                          "share correct." +
                          lines + " Bars: 95 % intervals over participants, for these fabrics." +
                          untestedText(analysis.data, question.findings)),
                  .section = PageSection::Speed,
                  .question = question.id()};
    plot.description = figure.caption;
    if (anyTimes(plot.points)) figure.svg = drawn(plot, width);
    return figure;
}

}  // namespace

std::vector<Figure> speedFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    std::vector<Figure> figures;
    const auto add = [&](Figure figure) {
        if (!figure.svg.empty()) figures.push_back(std::move(figure));
    };
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) {
        if (analysis.data.conditions.size() <= mostPoints) add(conditionsFigure(analysis, question, width));
        if (!question.findings.instructions.instructions.empty()) add(instructionsFigure(analysis, question, width));
    }
    return figures;
}

}  // namespace reports
