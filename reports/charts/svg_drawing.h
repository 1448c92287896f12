// Scalable drawings as text: no screen and no font engine is needed to write a figure.
#pragma once

#include <string>
#include <vector>

namespace reports {

struct SvgPoint {
    double x = 0;
    double y = 0;
};

enum class Anchor { Start, Middle, End };

struct SvgText {
    double size = 14;
    Anchor anchor = Anchor::Middle;
    std::string colour = "#22303a";
    bool bold = false;
    double rotation = 0;  ///< degrees, about the anchor
};

class SvgDrawing {
public:
    SvgDrawing(double width, double height, const std::string& title, const std::string& description);

    void line(SvgPoint from, SvgPoint to, const std::string& colour, double width, const std::string& dashes = {});
    void rectangle(SvgPoint corner, double width, double height, const std::string& fill, double opacity = 1,
                   const std::string& stroke = "none", const std::string& hint = {});
    void polygon(const std::vector<SvgPoint>& points, const std::string& fill, const std::string& stroke);
    void circle(SvgPoint centre, double radius, const std::string& fill, const std::string& stroke);
    /// `content` is already escaped, and may hold tspans.
    void text(SvgPoint at, const std::string& content, const SvgText& style = {});

    std::string finished() const;

private:
    std::string m_content;
    double m_width;
    double m_height;
    std::string m_title;
    std::string m_description;
};

}  // namespace reports
