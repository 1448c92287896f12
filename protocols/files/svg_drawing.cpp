#include "protocols/files/svg_drawing.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"

namespace protocols {

namespace {

/// Rounded to tenths of a pixel.
std::string length(double value)
{
    std::string text = fixed(value, 1);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
}

std::string attribute(const std::string& name, const std::string& value) { return " " + name + "=\"" + value + "\""; }

std::string attribute(const std::string& name, double value) { return attribute(name, length(value)); }

std::string listOf(const std::vector<SvgPoint>& points)
{
    std::string list;
    for (const SvgPoint& point : points) list += (list.empty() ? "" : " ") + length(point.x) + "," + length(point.y);
    return list;
}

std::string opacityOf(double opacity) { return opacity < 1 ? attribute("fill-opacity", fixed(opacity, 2)) : ""; }

std::string outline(const std::string& stroke)
{
    return stroke == "none" ? "" : attribute("stroke", stroke) + attribute("stroke-width", 1.5);
}

std::string anchorName(SvgAnchor anchor)
{
    switch (anchor) {
        case SvgAnchor::Start:
            return "start";
        case SvgAnchor::Middle:
            return "middle";
        case SvgAnchor::End:
            return "end";
    }
    return {};
}

}  // namespace

SvgDrawing::SvgDrawing(double width, double height, const std::string& title, const std::string& description)
    : m_width(width), m_height(height), m_title(title), m_description(description)
{
}

void SvgDrawing::line(SvgPoint from, SvgPoint to, const std::string& colour, double width, const std::string& dashes)
{
    m_content += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) + attribute("y2", to.y) +
                 attribute("stroke", colour) + attribute("stroke-width", width) +
                 (dashes.empty() ? "" : attribute("stroke-dasharray", dashes)) + "/>\n";
}

void SvgDrawing::polyline(const std::vector<SvgPoint>& points, const std::string& colour, double width)
{
    m_content += "<polyline" + attribute("points", listOf(points)) + attribute("fill", std::string("none")) +
                 attribute("stroke", colour) + attribute("stroke-width", width) + "/>\n";
}

void SvgDrawing::rectangle(SvgPoint corner, double width, double height, const std::string& fill, double opacity,
                           const std::string& stroke, const std::string& hint)
{
    m_content += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
                 attribute("height", height) + attribute("fill", fill) + opacityOf(opacity) + outline(stroke);
    m_content += hint.empty() ? "/>\n" : "><title>" + escapedMarkup(hint) + "</title></rect>\n";
}

void SvgDrawing::polygon(const std::vector<SvgPoint>& points, const std::string& fill, const std::string& stroke, double opacity)
{
    m_content += "<polygon" + attribute("points", listOf(points)) + attribute("fill", fill) + opacityOf(opacity) +
                 attribute("stroke", stroke) + attribute("stroke-width", 1.5) + "/>\n";
}

void SvgDrawing::circle(SvgPoint centre, double radius, const std::string& fill, const std::string& stroke)
{
    m_content += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) +
                 attribute("fill", fill) + attribute("stroke", stroke) + attribute("stroke-width", 1.5) + "/>\n";
}

void SvgDrawing::image(SvgPoint corner, double width, double height, const std::string& pngBase64)
{
    m_content += "<image" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
                 attribute("height", height) + attribute("href", "data:image/png;base64," + pngBase64) + "/>\n";
}

void SvgDrawing::text(SvgPoint at, const std::string& content, const SvgText& style)
{
    m_content +=
        "<text" + attribute("x", at.x) + attribute("y", at.y) + attribute("font-size", style.size) +
        attribute("text-anchor", anchorName(style.anchor)) + attribute("fill", style.colour) +
        (style.bold ? attribute("font-weight", std::string("600")) : "") +
        (style.rotation == 0
             ? ""
             : attribute("transform", "rotate(" + length(style.rotation) + " " + length(at.x) + " " + length(at.y) + ")")) +
        ">" + content + "</text>\n";
}

std::string SvgDrawing::finished() const
{
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 " + length(m_width) + " " + length(m_height) +
           "\" width=\"" + length(m_width) + "\" height=\"" + length(m_height) +
           "\" font-family=\"'Source Sans 3','Segoe UI','Helvetica Neue','Liberation Sans',Arial,sans-serif\">\n<title>" +
           escapedMarkup(m_title) + "</title>\n<desc>" + escapedMarkup(m_description) + "</desc>\n" + m_content + "</svg>\n";
}

std::vector<double> multiplesBetween(double low, double high, double step)
{
    // Larger multiples have no next whole number, so a loop over them would not end.
    constexpr double largestMultiple = 1e15;
    const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
    const bool isCountable = std::abs(first) <= largestMultiple && std::abs(last) <= largestMultiple;
    if (!std::isfinite(step) || !(step > 0) || !isCountable) return {};
    const int count = static_cast<int>(std::clamp(last - first + 1, 0.0, double(mostTicks)));
    std::vector<double> multiples;
    for (int i = 0; i < count; ++i) multiples.push_back((first + i) * step + 0.0);  // 0.0 removes the sign of a zero
    return multiples;
}

}  // namespace protocols
