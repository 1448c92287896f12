// Scalable drawings (SVG) as text. Writing a figure needs neither a screen nor a font engine. Also the ticks of axes.
#pragma once

#include <string>
#include <vector>

namespace protocols {

struct SvgPoint {
    double x = 0;
    double y = 0;
};

enum class SvgAnchor { Start, Middle, End };

struct SvgText {
    double size = 14;  ///< px
    SvgAnchor anchor = SvgAnchor::Middle;
    std::string colour = "#22303a";
    bool bold = false;
    double rotation = 0;  ///< degrees, about the anchor
};

/// Coordinates in px from the upper left corner.
class SvgDrawing {
public:
    /// `title` and `description` are plain text for readers who cannot see the drawing.
    SvgDrawing(double width, double height, const std::string& title, const std::string& description);

    void line(SvgPoint from, SvgPoint to, const std::string& colour, double width, const std::string& dashes = {});
    void polyline(const std::vector<SvgPoint>& points, const std::string& colour, double width);
    /// `hint` is plain text that appears under the pointer.
    void rectangle(SvgPoint corner, double width, double height, const std::string& fill, double opacity = 1,
                   const std::string& stroke = "none", const std::string& hint = {});
    void polygon(const std::vector<SvgPoint>& points, const std::string& fill, const std::string& stroke, double opacity = 1);
    void circle(SvgPoint centre, double radius, const std::string& fill, const std::string& stroke);
    /// A picture: a PNG file in Base64.
    void image(SvgPoint corner, double width, double height, const std::string& pngBase64);
    /// `content` is already escaped, and may hold tspans.
    void text(SvgPoint at, const std::string& content, const SvgText& style = {});

    /// The whole drawing as one <svg> element.
    std::string finished() const;

private:
    std::string m_content;
    double m_width;
    double m_height;
    std::string m_title;
    std::string m_description;
};

/// Largest number of ticks of an axis. The steps of all axes ask for far fewer.
inline constexpr int mostTicks = 100;

/// Multiples of `step` from `low` to `high`, rising. A multiple that misses a bound by a billionth of a step is included. At
/// most `mostTicks`; none where `step` is not above 0, or so small beside the bounds that rounding would join two ticks.
std::vector<double> multiplesBetween(double low, double high, double step);

}  // namespace protocols
