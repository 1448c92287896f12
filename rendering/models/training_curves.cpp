// curves.svg: small panels, one a column, so that numbers of different sizes stay legible.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "protocols/files/markup_text.h"
#include "rendering/models/training_table.h"

namespace rendering::models {

namespace {

constexpr int panelWidth = 440, panelHeight = 190, left = 62, right = 16, top = 30, bottom = 30, mostPoints = 220;
constexpr double logarithmicFrom = 30;  ///< greatest over least value

struct Point {
    double step = 0, mean = 0, low = 0, high = 0;
};

/// Neighbouring steps averaged, so that thousands of steps make a picture of bounded size.
std::vector<Point> pointsOf(const TrainingTable& table, const std::string& name)
{
    const std::vector<double> values = table.column(name);
    std::vector<std::pair<int, double>> there;
    for (auto row = table.rows.begin(); row != table.rows.end(); ++row)
        if (const double value = values[static_cast<std::size_t>(std::distance(table.rows.begin(), row))]; std::isfinite(value))
            there.emplace_back(row->first, value);
    const std::size_t together = (there.size() + mostPoints - 1) / mostPoints;
    std::vector<Point> points;
    for (std::size_t from = 0; from < there.size(); from += together) {
        const std::size_t end = std::min(there.size(), from + together);
        Point point{0, 0, there[from].second, there[from].second};
        for (std::size_t i = from; i < end; ++i) {
            point.step += there[i].first / static_cast<double>(end - from);
            point.mean += there[i].second / static_cast<double>(end - from);
            point.low = std::min(point.low, there[i].second);
            point.high = std::max(point.high, there[i].second);
        }
        points.push_back(point);
    }
    return points;
}

/// "0.05", "20", "1e-05": at most three digits, always with a point.
std::string shortly(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    std::replace(text, text + sizeof text, ',', '.');
    return text;
}

std::string at(double pixel)
{
    const long tenths = std::lround(pixel * 10);
    return (tenths < 0 ? "-" : "") + std::to_string(std::labs(tenths) / 10) + "." + std::to_string(std::labs(tenths) % 10);
}

struct Scale {
    double low = 0, high = 1;
    bool logarithmic = false;
    double placed(double value) const
    {
        const auto of = [this](double x) { return logarithmic ? std::log10(x) : x; };
        return (of(value) - of(low)) / (of(high) - of(low));
    }
};

Scale scaleFor(const std::vector<Point>& points)
{
    Scale scale{points.front().low, points.front().high, false};
    for (const Point& point : points) {
        scale.low = std::min(scale.low, point.low);
        scale.high = std::max(scale.high, point.high);
    }
    scale.logarithmic = scale.low > 0 && scale.high > logarithmicFrom * scale.low;
    if (!(scale.high > scale.low)) {
        const double room = scale.low == 0 ? 1 : std::abs(scale.low) / 10;
        scale = {scale.low - room, scale.high + room, false};
    }
    return scale;
}

/// Round steps on a plain axis, powers of ten (and the ends) on a logarithmic one.
std::vector<double> ticksOf(const Scale& scale)
{
    std::vector<double> ticks;
    if (scale.logarithmic) {
        for (double power = std::ceil(std::log10(scale.low)); power <= std::log10(scale.high); ++power)
            ticks.push_back(std::pow(10, power));
        if (ticks.size() < 2) ticks = {scale.low, scale.high};
        return ticks;
    }
    const double least = (scale.high - scale.low) / 5, power = std::pow(10, std::floor(std::log10(least)));
    const double step = least / power <= 2 ? 2 * power : least / power <= 5 ? 5 * power : 10 * power;
    for (double number = std::ceil(scale.low / step); number * step <= scale.high; ++number)
        ticks.push_back(number == 0 ? 0 : number * step);
    return ticks;
}

std::string text(double x, double y, const std::string& words, const char* anchor, const char* kind)
{
    return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor + "\" class=\"" + kind + "\">" + words +
           "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2)
{
    return "<path class=\"grid\" d=\"M" + at(x1) + " " + at(y1) + "L" + at(x2) + " " + at(y2) + "\"/>\n";
}

std::string panel(const std::string& title, const std::vector<Point>& points, double lastStep, int number)
{
    const double x0 = (number % 2) * panelWidth, y0 = (number / 2) * panelHeight;
    std::string svg = text(x0 + left, y0 + 18, protocols::escapedMarkup(title), "start", "title");
    if (points.empty()) return svg + text(x0 + left, y0 + 50, "no finite values", "start", "tick");
    const Scale scale = scaleFor(points);
    const auto x = [&](double step) { return x0 + left + step / std::max(1.0, lastStep) * (panelWidth - left - right); };
    const auto y = [&](double value) { return y0 + panelHeight - bottom - scale.placed(value) * (panelHeight - top - bottom); };
    svg += text(x0 + panelWidth - right, y0 + 18,
                "last " + shortly(points.back().mean) + (scale.logarithmic ? ", logarithmic" : ""), "end", "tick");
    for (const double tick : ticksOf(scale))
        svg += line(x(0), y(tick), x(lastStep), y(tick)) + text(x(0) - 6, y(tick) + 4, shortly(tick), "end", "tick");
    for (const double tick : ticksOf({0, std::max(1.0, lastStep), false}))
        svg += text(x(tick), y0 + panelHeight - bottom + 16, shortly(tick), "middle", "tick");
    std::string band, back, mean;
    for (const Point& point : points) {
        band += (band.empty() ? "M" : "L") + at(x(point.step)) + " " + at(y(point.high));
        back = "L" + at(x(point.step)) + " " + at(y(point.low)) + back;
        mean += (mean.empty() ? "M" : "L") + at(x(point.step)) + " " + at(y(point.mean));
    }
    svg += "<path class=\"band\" d=\"" + band + back + "Z\"/>\n<path class=\"mean\" d=\"" + mean + "\"/>\n";
    for (const Point& point : points)
        if (points.size() <= 40) svg += "<circle cx=\"" + at(x(point.step)) + "\" cy=\"" + at(y(point.mean)) + "\" r=\"2.2\"/>\n";
    return svg;
}

}  // namespace

std::string curvesSvg(const TrainingTable& losses, const TrainingTable& validation)
{
    const auto lastOf = [](const TrainingTable& table) { return table.rows.empty() ? 0 : table.rows.rbegin()->first; };
    const double last = std::max(lastOf(losses), lastOf(validation));
    std::string panels;
    int number = 0;
    for (const std::string& name : losses.names) panels += panel("loss: " + name, pointsOf(losses, name), last, number++);
    for (const std::string& name : validation.names)
        panels += panel("validation: " + name, pointsOf(validation, name), last, number++);
    const std::string width = std::to_string(2 * panelWidth), height = std::to_string((number + 1) / 2 * panelHeight + 24);
    const std::string middle = std::to_string(panelWidth);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height + "\" width=\"" + width +
           "\" height=\"" + height +
           "\">\n<style>text{font-family:sans-serif}.title{font-size:13px;font-weight:bold}.tick{font-size:11px;fill:#555}"
           ".grid{stroke:#ddd}.band{fill:#9cc3e6;fill-opacity:.6}.mean{fill:none;stroke:#0b4f8a;stroke-width:1.6}circle{fill:#"
           "0b4f8a}"
           "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
           panels + "<text x=\"" + middle + "\" y=\"" + std::to_string((number + 1) / 2 * panelHeight + 14) +
           "\" text-anchor=\"middle\" class=\"tick\">step</text>\n</svg>\n";
}

}  // namespace rendering::models
