#include "rendering/fabrics/recordings/friction_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "protocols/files/markup_text.h"

namespace rendering::fabrics {

namespace {

constexpr double left = 70, width = 800, right = left + width;

/// Tenths of a pixel.
std::string px(double value)
{
    const auto tenths = std::lround(value * 10);
    return (tenths < 0 ? "-" : "") + std::to_string(std::abs(tenths) / 10) + "." + std::to_string(std::abs(tenths) % 10);
}

std::string textAt(double x, double y, const std::string& words, const char* anchor = "start", const char* colour = "#333")
{
    return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\" fill=\"" + colour + "\">" +
           protocols::escapedMarkup(readable(words)) + "</text>\n";
}

/// Time along x and values along y within a frame.
struct Panel {
    double top, height, fromS, toS, low, high;

    double x(double timeS) const { return left + width * (timeS - fromS) / std::max(toS - fromS, 1e-300); }
    double y(double value) const { return top + height * (1 - (value - low) / (high - low)); }

    std::string frame(const std::string& unit) const
    {
        std::string svg = "<rect x=\"" + px(left) + "\" y=\"" + px(top) + "\" width=\"" + px(width) + "\" height=\"" +
                          px(height) + "\" fill=\"none\" stroke=\"#888\"/>\n";
        for (const double share : {0.0, 0.5, 1.0}) {
            const double value = low + share * (high - low);
            svg += textAt(left - 6, y(value) + 4, inShort(value), "end");
            svg += textAt(left + share * width, top + height + 16, inShort(fromS + share * (toS - fromS)) + " s",
                          share == 0   ? "start"
                          : share == 1 ? "end"
                                       : "middle");
        }
        return svg + textAt(left, top - 6, unit);
    }

    std::string band(double from, double to, const char* colour) const
    {
        const double a = std::clamp(x(from), left, right), b = std::clamp(x(to), left, right);
        return "<rect x=\"" + px(a) + "\" y=\"" + px(top) + "\" width=\"" + px(std::max(b - a, 0.5)) + "\" height=\"" +
               px(height) + "\" fill=\"" + colour + "\"/>\n";
    }

    /// At most 800 columns of least and greatest value.
    std::string line(std::size_t count, const auto& timeAt, const auto& valueAt, const char* colour) const
    {
        std::string points;
        const std::size_t together = std::max<std::size_t>(count / 800, 1);
        for (std::size_t i = 0; i < count; i += together) {
            double least = valueAt(i), most = least;
            for (std::size_t k = i; k < std::min(i + together, count); ++k) {
                least = std::min(least, valueAt(k));
                most = std::max(most, valueAt(k));
            }
            const std::string at = px(x(timeAt(i))) + ",";
            points += at + px(y(least)) + " ";
            if (together > 1) points += at + px(y(most)) + " ";
        }
        return "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1\"/>\n";
    }
};

Panel panelFor(double top, double height, double fromS, double toS, double low, double high)
{
    const double margin = high > low ? 0.05 * (high - low) : std::max(std::abs(low) * 0.1, 1e-9);
    return {top, height, fromS, toS, low - margin, high + margin};
}

std::string recorded(const RawRecord& record, const PreparedRecord& prepared)
{
    double low = 0, high = 0;  // forces are read against 0
    if (prepared.normalN.empty()) low = high = prepared.tangentialN.front();
    for (const auto* values : {&prepared.normalN, &prepared.tangentialN})
        for (const double value : *values) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    const auto& time = prepared.timeS;
    const Panel panel = panelFor(60, 200, time.front(), time.back(), low, high);
    const Rows steady = prepared.slide.steady;
    std::string svg = panel.band(time[steady.begin], time[steady.end - 1], "#dcefdc");
    if (prepared.zeroRows) svg += panel.band(time[prepared.zeroRows->begin], time[prepared.zeroRows->end - 1], "#dce6f5");
    const auto timeAt = [&](std::size_t i) { return time[i]; };
    svg += panel.line(
        time.size(), timeAt, [&](std::size_t i) { return prepared.tangentialN[i]; }, "#b3401f");
    if (!prepared.normalN.empty())
        svg += panel.line(
            time.size(), timeAt, [&](std::size_t i) { return prepared.normalN[i]; }, "#1f4fb3");
    svg +=
        panel.frame(prepared.normalN.empty() ? "recorded: " + record.quantity : "recorded, N: normal (blue), tangential (red)");
    return svg + textAt(right, 54,
                        std::string("green: the slide that is kept") + (prepared.zeroRows ? "; pale blue: unloaded, zero" : ""),
                        "end");
}

std::string kept(const RawRecord& record, const PreparedRecord& prepared)
{
    const auto valueAt = [&](std::size_t i) {
        return prepared.evenNormalN.empty() ? prepared.values[i] : prepared.values[i] / prepared.evenNormalN[i];
    };
    double low = valueAt(0), high = low;
    for (std::size_t i = 0; i < prepared.values.size(); ++i) {
        low = std::min(low, valueAt(i));
        high = std::max(high, valueAt(i));
    }
    const double from = prepared.timeS[prepared.slide.steady.begin];
    const auto timeAt = [&](std::size_t i) { return from + double(i) * prepared.stepS; };
    const Panel panel = panelFor(330, 180, from, timeAt(prepared.values.size() - 1), low, high);
    std::string svg = panel.line(prepared.values.size(), timeAt, valueAt, "#333");
    svg += "<line x1=\"" + px(left) + "\" x2=\"" + px(right) + "\" y1=\"" + px(panel.y(prepared.mean)) + "\" y2=\"" +
           px(panel.y(prepared.mean)) + "\" stroke=\"#b38f1f\" stroke-dasharray=\"6 4\"/>\n";
    svg += panel.frame("kept: " + (prepared.evenNormalN.empty() ? record.quantity : std::string("coefficient of friction")) +
                       ", " + std::to_string(prepared.values.size()) + " samples at " + inShort(1 / prepared.stepS) + " Hz");
    return svg + textAt(right, 324, "mean " + inShort(prepared.mean) + " (dashed), sd " + inShort(prepared.sd), "end");
}

/// What was done, over as many lines as it takes; wide letters need 7 px.
std::string footnote(const PreparedRecord& prepared)
{
    std::string words = describeCuts(prepared).substr(2), svg;
    for (double y = 550; !words.empty(); y += 16) {
        std::size_t end = words.size();
        if (end > 120) end = std::min(words.rfind(' ', 120), end);
        svg += textAt(left, y, words.substr(0, end));
        words.erase(0, end + 1);
    }
    return svg;
}

}  // namespace

std::string frictionPlot(const std::string& title, const RawRecord& record, const PreparedRecord& prepared)
{
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"600\" font-family=\"sans-serif\" font-size=\"12\">\n"
           "<rect width=\"900\" height=\"600\" fill=\"#fff\"/>\n" +
           textAt(left, 24, title) + recorded(record, prepared) + kept(record, prepared) + footnote(prepared) + "</svg>\n";
}

}  // namespace rendering::fabrics
