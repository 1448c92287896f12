#include "reports/charts/svg_drawing.h"

#include "reports/text/number_text.h"

namespace reports {
namespace {

std::string length(double value)
{
    std::string text = fixed(value, 1);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
}

std::string attribute(const std::string& name, const std::string& value) { return " " + name + "=\"" + value + "\""; }

std::string attribute(const std::string& name, double value) { return attribute(name, length(value)); }

std::string anchorName(Anchor anchor)
{
    switch (anchor) {
        case Anchor::Start:
            return "start";
        case Anchor::Middle:
            return "middle";
        case Anchor::End:
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

void SvgDrawing::rectangle(SvgPoint corner, double width, double height, const std::string& fill, double opacity,
                           const std::string& stroke, const std::string& hint)
{
    m_content += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
                 attribute("height", height) + attribute("fill", fill) +
                 (opacity < 1 ? attribute("fill-opacity", fixed(opacity, 2)) : "") +
                 (stroke == "none" ? "" : attribute("stroke", stroke) + attribute("stroke-width", 1.5));
    m_content += hint.empty() ? "/>\n" : "><title>" + escapedHtml(hint) + "</title></rect>\n";
}

void SvgDrawing::polygon(const std::vector<SvgPoint>& points, const std::string& fill, const std::string& stroke)
{
    std::string list;
    for (const SvgPoint& point : points) list += (list.empty() ? "" : " ") + length(point.x) + "," + length(point.y);
    m_content += "<polygon" + attribute("points", list) + attribute("fill", fill) + attribute("stroke", stroke) +
                 attribute("stroke-width", 1.5) + "/>\n";
}

void SvgDrawing::circle(SvgPoint centre, double radius, const std::string& fill, const std::string& stroke)
{
    m_content += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) +
                 attribute("fill", fill) + attribute("stroke", stroke) + attribute("stroke-width", 1.5) + "/>\n";
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
           escapedHtml(m_title) + "</title>\n<desc>" + escapedHtml(m_description) + "</desc>\n" + m_content + "</svg>\n";
}

}  // namespace reports
