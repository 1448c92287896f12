// A table as shades of one hue with its numbers in the cells: readable in grey and with any kind of colour vision.
#pragma once

#include <string>
#include <vector>

#include "reports/charts/figure_width.h"
#include "stats/kernels/value.h"

namespace reports {

/// A label as content of a <text> element, with its approximate width in characters.
struct HeatMapLabel {
    std::string svg;
    double length = 0;
};

struct HeatMapCell {
    stats::Value shade;  ///< between `low` and `high` of the map; a cell without a value stays white
    std::string text;    ///< plain
};

struct HeatMap {
    std::string title;        ///< plain text, as is the description
    std::string description;  ///< for readers who cannot see the figure
    std::string rowTitle;
    std::string columnTitle;
    std::vector<HeatMapLabel> rows;
    std::vector<HeatMapLabel> columns;
    std::vector<std::vector<HeatMapCell>> cells;  ///< [rows x columns]
    double low = 0;                               ///< white
    double high = 1;                              ///< darkest; above `low`
    std::string lowText, highText;                ///< words at the ends of the legend
};

/// The map as an <svg> element.
std::string drawn(const HeatMap& map, FigureWidth width);

}  // namespace reports
