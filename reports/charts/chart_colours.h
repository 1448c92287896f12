// The colours of the figures. Okabe and Ito's, which people with any kind of colour blindness can tell apart.
#pragma once

#include <cstddef>
#include <string>

#include "protocols/condition.h"

namespace reports {

struct ChartColours {
    inline static const std::string blue = "#0072B2";
    inline static const std::string orange = "#E69F00";
    inline static const std::string green = "#009E73";
    inline static const std::string vermilion = "#D55E00";
    inline static const std::string purple = "#CC79A7";
    inline static const std::string slate = "#56718a";
    inline static const std::string ink = "#22303a";
    inline static const std::string grey = "#5b6770";
    inline static const std::string pale = "#aab6bf";  ///< lines behind points
    inline static const std::string faint = "#dfe4e8";
    inline static const std::string white = "#ffffff";
};

/// The colour of the bars and bands of vision, generated and measured conditions.
const std::string& groupColour(protocols::ConditionGroup group);

/// The colour of all bars where conditions have no group.
const std::string& plainColour();

/// The colour of the k-th question in a figure of several; five colours, then the first again.
const std::string& seriesColour(std::size_t k);

}  // namespace reports
