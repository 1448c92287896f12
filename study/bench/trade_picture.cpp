#include "study/bench/trade_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "protocols/files/markup_text.h"
#include "protocols/files/svg_drawing.h"
#include "reports/charts/chart_colours.h"
#include "study/bench/preset_choice.h"

namespace study::bench {

namespace {

using protocols::SvgAnchor;
using protocols::SvgPoint;
using reports::ChartColours;

std::string threeDigits(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// A logarithmic axis over positive values. Zero has the place of its lower end.
struct LogAxis {
    double low = 1, high = 1;

    explicit LogAxis(std::vector<double> values)
    {
        std::erase_if(values, [](double value) { return !(value > 0); });
        if (values.empty()) return;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        // Room for a factor of two at least, so that equal values lie in the middle.
        const double room = std::max(1.3, 2 * *least / *most);
        low = *least / room;
        high = *most * room;
    }
    double share(double value) const { return value > 0 ? std::log(value / low) / std::log(high / low) : 0; }
};

struct PanelAxes {
    LogAxis ms, error;

    explicit PanelAxes(const TradePanel& panel) : ms(valuesOf(panel, true)), error(valuesOf(panel, false)) {}

    static std::vector<double> valuesOf(const TradePanel& panel, bool ofTime)
    {
        std::vector<double> values;
        for (const BenchRow& row : panel.rows) values.push_back(ofTime ? *row.milliseconds : *row.error);
        return values;
    }
};

/// "B" for the setting of a preset, "FBA" where all three have it.
std::string lettersOf(const BenchRow& row)
{
    static const std::vector<StageChoice> shipped = presetChoices({});
    std::string letters;
    for (const StageChoice& choice : shipped)
        if (choice.stage == row.stage)
            for (std::size_t i = 0; i < choice.shipped.size(); ++i)
                if (choice.shipped[i] == row.quality) letters += "FBA"[i];
    return letters;
}

std::string labelOf(const BenchRow& row)
{
    const std::string letters = lettersOf(row);
    return row.quality + (letters.empty() ? "" : " [" + letters + "]");
}

constexpr double panelWidth = 350, panelHeight = 250, headHeight = 76, panelsAcross = 3;
constexpr double plotLeft = 20, plotTop = 44, plotWidth = 300, plotHeight = 150;

class PanelDrawing {
public:
    PanelDrawing(protocols::SvgDrawing& drawing, SvgPoint corner) : m_drawing(drawing), m_corner(corner) {}

    SvgPoint at(double across, double up) const
    {
        return {m_corner.x + plotLeft + across * plotWidth, m_corner.y + plotTop + (1 - up) * plotHeight};
    }
    void words(SvgPoint place, const std::string& text, double size, SvgAnchor anchor, const std::string& colour,
               bool bold = false)
    {
        m_drawing.text(place, protocols::escapedMarkup(text), {size, anchor, colour, bold, 0});
    }
    void frame(const std::string& title, const std::string& unit, const std::string& left, const std::string& right)
    {
        words({m_corner.x + plotLeft, m_corner.y + 16}, title, 14, SvgAnchor::Start, ChartColours::ink, true);
        words({m_corner.x + plotLeft, m_corner.y + 34}, unit, 11, SvgAnchor::Start, ChartColours::grey);
        m_drawing.line(at(0, 0), at(1, 0), ChartColours::grey, 1);
        m_drawing.line(at(0, 0), at(0, 1), ChartColours::grey, 1);
        const double below = m_corner.y + plotTop + plotHeight + 16;
        words({at(0, 0).x, below}, left, 11, SvgAnchor::Start, ChartColours::grey);
        words({at(1, 0).x, below}, right, 11, SvgAnchor::End, ChartColours::grey);
    }

private:
    protocols::SvgDrawing& m_drawing;
    SvgPoint m_corner;
};

/// Labels lie above and right of their points, or left where there is no room; each avoids the earlier ones upwards.
void drawLabels(PanelDrawing& panel, const std::vector<std::pair<SvgPoint, std::string>>& labels, double rightEdge)
{
    struct Taken {
        double left, right, y;
    };
    std::vector<Taken> taken;
    for (const auto& [point, text] : labels) {
        const double length = 6.2 * static_cast<double>(text.size());
        const bool toTheLeft = point.x + 6 + length > rightEdge;
        Taken place{toTheLeft ? point.x - 6 - length : point.x + 6, toTheLeft ? point.x - 6 : point.x + 6 + length, point.y - 7};
        const auto meets = [&place](const Taken& other) {
            return std::abs(other.y - place.y) < 12 && other.left < place.right && place.left < other.right;
        };
        while (std::any_of(taken.begin(), taken.end(), meets)) place.y -= 12;
        taken.push_back(place);
        panel.words({toTheLeft ? place.right : place.left, place.y}, text, 11, toTheLeft ? SvgAnchor::End : SvgAnchor::Start,
                    ChartColours::ink);
    }
}

void drawStage(protocols::SvgDrawing& drawing, SvgPoint corner, const TradePanel& stage)
{
    PanelDrawing panel(drawing, corner);
    const PanelAxes axes(stage);
    panel.frame(stage.stage, "error (up): " + stage.errorUnit,
                threeDigits(*stage.rows.front().milliseconds) + " ms, error " + threeDigits(*stage.rows.front().error),
                threeDigits(*stage.rows.back().milliseconds) + " ms, error " + threeDigits(*stage.rows.back().error));
    std::vector<SvgPoint> front;
    std::vector<std::pair<SvgPoint, std::string>> labels;
    for (const BenchRow& row : stage.rows) {
        const SvgPoint point = panel.at(axes.ms.share(*row.milliseconds), axes.error.share(*row.error));
        if (row.onFront) front.push_back(point);
        labels.emplace_back(point, labelOf(row));
    }
    drawing.polyline(front, ChartColours::blue, 1.5);
    for (std::size_t i = 0; i < labels.size(); ++i)
        drawing.circle(labels[i].first, 4.5, stage.rows[i].onFront ? ChartColours::blue : ChartColours::white,
                       ChartColours::blue);
    drawLabels(panel, labels, panel.at(1, 0).x + 20);
}

void drawCurve(protocols::SvgDrawing& drawing, SvgPoint corner, const CostCurve& curve)
{
    PanelDrawing panel(drawing, corner);
    std::vector<double> sizes, times;
    for (const CostPoint& point : curve.points) {
        sizes.push_back(point.size);
        times.push_back(point.milliseconds);
    }
    const LogAxis size(sizes), ms(times);
    const std::string exponent = curve.exponent ? "time ~ size^" + threeDigits(*curve.exponent) : "one size only";
    panel.frame(curve.work, exponent + (curve.isLinear ? ", promised at most 1.05" : ""),
                threeDigits(sizes.front()) + " " + curve.sizeIs + ": " + threeDigits(times.front()) + " ms",
                threeDigits(sizes.back()) + ": " + threeDigits(times.back()) + " ms");
    std::vector<SvgPoint> line;
    for (const CostPoint& point : curve.points) line.push_back(panel.at(size.share(point.size), ms.share(point.milliseconds)));
    drawing.polyline(line, ChartColours::green, 1.5);
    for (const SvgPoint& point : line) drawing.circle(point, 4, ChartColours::green, ChartColours::green);
}

/// One panel in characters: the plot, and below it the least and the greatest time.
std::vector<std::string> linesOf(const TradePanel& stage, std::size_t width)
{
    constexpr std::size_t rows = 7;
    const PanelAxes axes(stage);
    std::vector<std::string> plot(rows, std::string(width - 1, ' '));
    const auto place = [](double share, std::size_t cells) {
        return static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * static_cast<double>(cells - 1)));
    };
    std::vector<std::pair<std::size_t, std::size_t>> points;
    for (const BenchRow& row : stage.rows)
        points.emplace_back(rows - 1 - place(axes.error.share(*row.error), rows),
                            place(axes.ms.share(*row.milliseconds), width - 1));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::string label = labelOf(stage.rows[i]);
        const auto [line, column] = points[i];
        const bool toTheLeft = column + 2 + label.size() > width - 1 && column >= label.size() + 1;
        const std::size_t first = toTheLeft ? column - label.size() - 1 : column + 2;
        // A label that finds no free line is left out; the table above the picture has every setting.
        for (const std::size_t tried : {line, line > 0 ? line - 1 : line + 1, std::min(line + 1, rows - 1)}) {
            if (first + label.size() > width - 1) break;
            if (plot[tried].substr(first, label.size()).find_first_not_of(' ') != std::string::npos) continue;
            plot[tried].replace(first, label.size(), label);
            break;
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) plot[points[i].first][points[i].second] = stage.rows[i].onFront ? '*' : 'o';
    std::vector<std::string> lines{stage.stage.substr(0, width), ("error (up): " + stage.errorUnit).substr(0, width)};
    for (const std::string& line : plot) lines.push_back("|" + line);
    lines.push_back("+" + std::string(width - 1, '-'));
    const std::string first = threeDigits(*stage.rows.front().milliseconds) + " ms",
                      last = threeDigits(*stage.rows.back().milliseconds) + " ms";
    lines.push_back(first + std::string(width - first.size() - last.size(), ' ') + last);
    return lines;
}

}  // namespace

std::vector<TradePanel> tradePanels(const std::vector<BenchRow>& rows)
{
    std::vector<TradePanel> panels;
    for (const BenchRow& row : rows) {
        if (!row.milliseconds || !row.error || !(*row.milliseconds > 0)) continue;
        auto panel = std::find_if(panels.begin(), panels.end(), [&](const TradePanel& one) {
            return one.stage == row.stage && one.errorUnit == row.errorUnit;
        });
        if (panel == panels.end()) panel = panels.insert(panels.end(), {row.stage, row.errorUnit, {}});
        panel->rows.push_back(row);
    }
    std::erase_if(panels, [](const TradePanel& panel) { return panel.rows.size() < 2; });
    for (TradePanel& panel : panels)
        std::stable_sort(panel.rows.begin(), panel.rows.end(),
                         [](const BenchRow& a, const BenchRow& b) { return *a.milliseconds < *b.milliseconds; });
    return panels;
}

std::string tradeSvg(const std::vector<BenchRow>& rows, const std::vector<CostCurve>& curves, const std::string& machine)
{
    const auto panels = tradePanels(rows);
    const std::size_t count = panels.size() + curves.size();
    const double width = panelsAcross * panelWidth, down = std::ceil(static_cast<double>(count) / panelsAcross);
    protocols::SvgDrawing drawing(width, headHeight + std::max(1.0, down) * panelHeight, "Speed against accuracy",
                                  "One panel for each stage: time to the right, error upwards, both logarithmic. " + machine);
    const auto write = [&](double y, const std::string& text, double size, bool bold) {
        drawing.text({plotLeft, y}, protocols::escapedMarkup(text), {size, SvgAnchor::Start, ChartColours::ink, bold, 0});
    };
    write(26, "Speed against accuracy: " + machine, 18, true);
    write(46,
          "Time to the right, error upwards; both axes logarithmic. Filled: on the Pareto front. F fast, B balanced, A accurate.",
          12, false);
    for (std::size_t i = 0; i < count; ++i) {
        const SvgPoint corner{static_cast<double>(i % 3) * panelWidth, headHeight + static_cast<double>(i / 3) * panelHeight};
        if (i < panels.size())
            drawStage(drawing, corner, panels[i]);
        else
            drawCurve(drawing, corner, curves[i - panels.size()]);
    }
    return drawing.finished();
}

std::string tradeInCharacters(const std::vector<BenchRow>& rows, std::size_t columns)
{
    constexpr std::size_t least = 38, gap = 3;
    const std::size_t across = std::max<std::size_t>(1, (columns + gap) / (least + gap)), width = (columns + gap) / across - gap;
    const auto panels = tradePanels(rows);
    std::string text;
    for (std::size_t i = 0; i < panels.size(); i += across) {
        std::vector<std::vector<std::string>> beside;
        for (std::size_t k = i; k < std::min(i + across, panels.size()); ++k)
            beside.push_back(linesOf(panels[k], std::max(width, least)));
        for (std::size_t line = 0; line < beside.front().size(); ++line) {
            std::string whole;
            for (const auto& lines : beside) {
                whole.resize(whole.empty() ? 0 : (whole.size() + gap), ' ');
                whole +=
                    lines[line] + std::string(std::max(width, least) - std::min(std::max(width, least), lines[line].size()), ' ');
            }
            whole.erase(whole.find_last_not_of(' ') + 1);
            text += whole + "\n";
        }
        text += "\n";
    }
    return text + (panels.empty() ? "" : "* on the Pareto front; o not; F, B, A: settings of fast, balanced, accurate\n");
}

}  // namespace study::bench
