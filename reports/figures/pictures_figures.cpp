#include "reports/figures/pictures_figures.h"

#include <algorithm>

#include "protocols/files/svg_drawing.h"
#include "reports/charts/chart_colours.h"
#include "reports/text/condition_label.h"

namespace reports {
namespace {

using protocols::SvgAnchor;

constexpr double gap = 4, letter = 8.2;  // px
constexpr double labelsTop = 30;         // px, above the pictures

class PictureSheet {
public:
    PictureSheet(const StudyData& data, FigureWidth width, const std::string& description)
        : m_data(data),
          m_left(12 + letter * longestFabric(data)),
          m_pictureWidth(
              std::clamp(((width == FigureWidth::OneColumn ? 490 : 900) - m_left) / double(data.conditions.size()) - gap,
                         width == FigureWidth::OneColumn ? 38.0 : 60.0, double(pictureWidth))),
          m_isCrowded(letter * longestCondition(data) > m_pictureWidth),
          m_top(labelsTop + (m_isCrowded ? 0.6 * letter * longestCondition(data) : 0)),
          m_drawing(x(data.conditions.size()) + (m_isCrowded ? 30 : 0), y(data.fabrics.size()), "Friction images", description)
    {
    }

    std::string drawn()
    {
        for (std::size_t c = 0; c < m_data.conditions.size(); ++c) {
            const protocols::SvgPoint place{x(c) + m_pictureWidth / 2, m_top - 9};
            m_drawing.text(place, svgLabel(m_data.conditions[c]),
                           m_isCrowded ? protocols::SvgText{.anchor = SvgAnchor::Start, .rotation = -35} : protocols::SvgText{});
        }
        for (std::size_t f = 0; f < m_data.fabrics.size(); ++f)
            m_drawing.text({m_left - 8, y(f) + pictureHeightDrawn() / 2 + 5}, svgLabel(m_data.fabrics[f]),
                           {.anchor = SvgAnchor::End});
        for (const FrictionPicture& picture : m_data.pictures) {
            const std::size_t c = placeOf(m_data.conditions, picture.condition), f = placeOf(m_data.fabrics, picture.fabric);
            if (c < m_data.conditions.size() && f < m_data.fabrics.size())
                m_drawing.image({x(c), y(f)}, m_pictureWidth, pictureHeightDrawn(), picture.pngBase64);
        }
        return m_drawing.finished();
    }

private:
    static std::size_t placeOf(const std::vector<std::string>& names, const std::string& name)
    {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    }
    static double longestFabric(const StudyData& data) { return longestLabel(data.fabrics); }
    static double longestCondition(const StudyData& data) { return longestLabel(data.conditions); }
    static double longestLabel(const std::vector<std::string>& names)
    {
        double longest = 0;
        for (const std::string& name : names) longest = std::max(longest, labelLength(name));
        return longest;
    }

    double pictureHeightDrawn() const { return m_pictureWidth * pictureHeight / pictureWidth; }
    double x(std::size_t condition) const { return m_left + double(condition) * (m_pictureWidth + gap); }
    double y(std::size_t fabric) const { return m_top + double(fabric) * (pictureHeightDrawn() + gap); }

    const StudyData& m_data;
    double m_left;
    double m_pictureWidth;  ///< as drawn, px
    bool m_isCrowded;       ///< labels of conditions slant
    double m_top;
    protocols::SvgDrawing m_drawing;
};

}  // namespace

std::vector<Figure> picturesFigures(const StudyAnalysis& analysis, FigureWidth width)
{
    const StudyData& data = analysis.data;
    if (data.pictures.empty()) return {};
    Figure figure{
        .name = "friction_images",
        .caption = "The friction images that the participants felt, by condition (columns) and fabric (rows): the middle " +
                   std::to_string(pictureWidth) + " \u00D7 " + std::to_string(pictureHeight) +
                   " pixels of each. Bright: high friction.",
        .section = PageSection::Signals};
    figure.svg = PictureSheet(data, width, figure.caption).drawn();
    return {std::move(figure)};
}

}  // namespace reports
