// From what an instrument recorded to what a data set keeps: zero taken off, axes joined, cut to the steady
// slide, at even time steps. Everything that was done is in the result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rendering/fabrics/recordings/even_steps.h"
#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/import_kinds.h"
#include "rendering/fabrics/recordings/steady_slide.h"

namespace rendering::fabrics {

struct PreparedRecord {
    // As recorded, after zero and joined axes; for the plot.
    std::vector<double> timeS;                 ///< from 0
    std::vector<double> tangentialN, normalN;  ///< N, or the quantity and nothing

    std::optional<Rows> zeroRows;  ///< unloaded; their means were subtracted
    double zeroNormalN = 0;
    std::vector<double> zeroTangentialN;  ///< one an axis
    bool normalTurned = false;            ///< compression was negative
    Slide slide;
    std::size_t leftOut = 0;  ///< of the steady part: too little normal force

    // As kept.
    TimeBase base;           ///< of the steady part's own stamps
    std::string resampling;  ///< "none", "linear between neighbours", "mean over each period"
    double stepS = 0;
    std::vector<double> values, evenNormalN;  ///< at even steps
    double mean = 0;                          ///< of the coefficient, or of the quantity
    double sd = 0;
    std::vector<std::string> warnings;
};

/// Throws badInput naming the record's file, and the row where one is at fault: time that does not rise, no
/// contact, forces or a coefficient that no unit makes plausible, contact lost within the slide (more than
/// 1 % of its samples below leastShareOfLoad of the median normal force, or below 0.05 N), an interval
/// without samples, a gap too long to fill.
PreparedRecord prepared(const RawRecord& record, const FrictionOptions& options);

/// For people: ", slide 0.5 to 8.5 s of 10 s (approach 0.2 s, breakaway 0.3 s, stop 1.5 s cut)" and the like.
std::string describeCuts(const PreparedRecord& prepared);

/// The text of the file beside the record, e.g. F01/friction/000.json.
std::string preparationJson(const RawRecord& record, const FrictionOptions& options, const PreparedRecord& prepared);

/// Four significant figures, for people.
std::string inShort(double value);

}  // namespace rendering::fabrics
