#include "reports/figures/matches_figures.h"

#include <algorithm>
#include <cmath>

#include "reports/charts/chart_colours.h"
#include "reports/charts/plot_frame.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// The interval of the share correct, in matches.
stats::Interval inMatches(const stats::Interval& share, double participants)
{
    if (!share.low.exists() || !share.high.exists()) return share;
    return {*share.low * participants, *share.high * participants};
}

/// A mean share and its 95 % interval with participants and fabrics as samples; of participants alone where fabrics cannot be
/// one. The interval may leave 0 to 1.
struct DrawnShare {
    stats::Value estimate;
    stats::Interval ci95;
    stats::Generalisation generalisation = stats::Generalisation::FabricsLikeThese;  ///< what the interval holds for
};

DrawnShare shareOf(const ChoiceAnalysis& choices, const std::string& condition)
{
    DrawnShare share;
    for (const ChanceFinding& finding : choices.claims.aboveChance) {
        const stats::Interval& ci = finding.claim.mean.ci95;
        if (finding.condition == condition && ci.low.exists()) share = {finding.claim.mean.estimate, ci, finding.generalisation};
    }
    return share;
}

/// The share that belongs to the interval, in matches per rendering. It is that of all trials for participants with equally many;
/// only rounding could tell the two apart.
stats::Value heightOfBar(const ConditionChoices& choices, const DrawnShare& share, double participants)
{
    constexpr double rounding = 1e-9;
    if (!choices.matchesPerRendering.exists() || !share.estimate.exists()) return choices.matchesPerRendering;
    const double mean = std::clamp(*share.estimate, 0.0, 1.0) * participants;
    return std::fabs(mean - *choices.matchesPerRendering) <= rounding * participants ? choices.matchesPerRendering
                                                                                     : stats::Value(mean);
}

/// The number at the foot of its bar; a pale plate keeps it readable where the whisker reaches it.
void drawNumber(PlotFrame& plot, protocols::SvgPoint foot, const std::string& number, const stats::Interval& whisker)
{
    constexpr double size = 15, character = 9;  // px
    const double width = character * static_cast<double>(number.size());
    if (whisker.low.exists() && plot.y(*whisker.low) > foot.y - size)
        plot.drawing().rectangle({foot.x - width / 2, foot.y - size + 2}, width, size + 1, ChartColours::white, 0.85);
    plot.drawing().text(foot, number, {.size = size, .bold = true});
}

void drawBar(PlotFrame& plot, std::size_t i, const ConditionChoices& choices, const DrawnShare& share, double participants,
             const std::string& colour)
{
    const stats::Value matches = heightOfBar(choices, share, participants);
    const protocols::SvgPoint foot{plot.centre(i), plot.y(0) - 8};
    if (!matches.exists()) {
        plot.drawing().text(foot, "no data", {.size = 13, .colour = ChartColours::grey});
        return;
    }
    const double width = std::min(54.0, plot.slot() * 0.62);
    plot.drawing().rectangle({plot.centre(i) - width / 2, plot.y(*matches)}, width, plot.y(0) - plot.y(*matches), colour, 0.45,
                             colour, plot.conditions()[i] + ": " + fixed(*matches, 2));
    const stats::Interval whisker = inMatches(share.ci95, participants);
    plot.drawErrorBar(plot.centre(i), whisker, ChartColours::ink);
    drawNumber(plot, foot, fixed(*matches, 1), whisker);
}

/// What the whiskers of a figure are; empty texts where it has none.
struct WhiskerText {
    std::string caption, remark;
};

WhiskerText whiskerText(const std::vector<std::string>& conditions, const std::vector<DrawnShare>& shares)
{
    std::size_t drawn = 0;
    std::vector<std::string> overParticipants;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (!shares[i].ci95.low.exists()) continue;
        ++drawn;
        if (shares[i].generalisation == stats::Generalisation::TheseFabrics) overParticipants.push_back(conditions[i]);
    }
    if (drawn == 0) return {};
    if (overParticipants.empty())
        return {" Whiskers: its 95 % interval with participants and fabrics as samples.",
                "whiskers: 95 % interval, participants and fabrics"};
    if (overParticipants.size() == drawn)
        return {" Whiskers: its 95 % interval over participants, for these fabrics.", "whiskers: 95 % interval, participants"};
    return {" Whiskers: its 95 % interval with participants and fabrics as samples; under " + listed(overParticipants) +
                " over participants, for these fabrics.",
            "whiskers: 95 % interval, see the caption"};
}

void drawChanceLine(PlotFrame& plot, double chance, const std::string& people)
{
    const std::string dashes = "7 5";
    plot.drawing().line({plot.left(), plot.y(chance)}, {plot.rightEdge(), plot.y(chance)}, ChartColours::vermilion, 2, dashes);
    plot.drawing().line({plot.left(), PlotFrame::legendY()}, {plot.left() + 34, PlotFrame::legendY()}, ChartColours::vermilion, 2,
                        dashes);
    plot.drawLegendText(plot.left() + 42, protocols::SvgAnchor::Start, "chance: " + fixed(chance, 1) + " of " + people);
}

Figure matchesFigure(const StudyAnalysis& analysis, const std::string& id, const ChoiceAnalysis& choices, FigureWidth width)
{
    const std::size_t people = answeringParticipants(analysis.data, choices);
    const auto participants = static_cast<double>(std::max<std::size_t>(1, people));
    const int m = shownChance(choices);
    std::vector<DrawnShare> shares;
    for (const std::string& condition : analysis.data.conditions) shares.push_back(shareOf(choices, condition));
    const WhiskerText whiskers = whiskerText(analysis.data.conditions, shares);
    const std::string chance =
        (m > 0 ? " Dashed line: chance, 1/" + std::to_string(m) + "." : "") + untestedText(analysis.data, choices);
    Figure figure{
        .name = "matches_" + id,
        .caption = stampedCaption(analysis.data, id + ": correct matches per rendering, of " + counted(people, "participant") +
                                                     ". Bars: mean share correct times the number of participants." +
                                                     whiskers.caption + chance),
        .section = PageSection::Matches,
        .question = id};
    PlotFrame plot(analysis.data.conditions, 0, participants, id + ": matches per rendering by condition", figure.caption,
                   {width, width == FigureWidth::OneColumn ? 2 : 1});
    plot.drawFrame("matches per rendering (of " + std::to_string(people) + ")");
    plot.drawRightAxis(participants, "share correct");
    for (std::size_t i = 0; i < plot.conditions().size(); ++i)
        drawBar(plot, i, choices.conditions[i], shares[i], participants,
                plot.hasGroups() ? groupColour(*groupOf(plot.conditions()[i])) : plainColour());
    if (m > 0) drawChanceLine(plot, participants / m, std::to_string(people));
    if (!whiskers.remark.empty()) plot.drawRemark(whiskers.remark);
    figure.svg = plot.drawing().finished();
    return figure;
}

}  // namespace

std::vector<Figure> matchesFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    std::vector<Figure> figures;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis))
        figures.push_back(matchesFigure(analysis, question.id(), question.findings, width));
    return figures;
}

}  // namespace reports
