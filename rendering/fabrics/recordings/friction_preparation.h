// From a recorded stroke to the record in a data set: zero subtracted, axes combined, cut to the steady slide,
// resampled to even time steps. The result lists every step of this processing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rendering/fabrics/recordings/even_steps.h"
#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/raw_record.h"
#include "rendering/fabrics/recordings/steady_slide.h"

namespace rendering::fabrics {

struct PreparedRecord {
    // The recording after zero subtraction and combination of the axes, for the plot.
    std::vector<double> timeS;                 ///< from 0
    std::vector<double> tangentialN, normalN;  ///< forces in N; or the quantity, and `normalN` empty

    std::optional<RowRange> zeroRows;  ///< unloaded rows, whose means were subtracted
    bool lacksZero = false;            ///< true where the options ask for a zero and no samples are unloaded
    double zeroNormalN = 0;
    std::vector<double> zeroTangentialN;  ///< one value for each axis
    bool normalReversed = false;          ///< true where compression was negative
    Slide slide;
    std::size_t leftOut = 0;  ///< samples of the steady part with too little normal force

    // The kept part.
    std::optional<double> speedMmPerS;  ///< mean over its rows where they have speeds, else that of the record
    TimeBase base;                      ///< time base of the steady part's stamps
    std::string resampling;             ///< "none", "linear between neighbours", "mean over each period"
    double stepS = 0;
    std::vector<double> values, evenNormalN;  ///< at even steps
    double mean = 0;                          ///< mean coefficient, or mean of the quantity
    double sd = 0;
    std::vector<std::string> warnings;
};

/// Prepares a record. Throws badInput naming its file and, where one row is at fault, that row. Faults of the time: time
/// that does not increase, an interval without samples, a gap too long to fill, a sample rate outside leastRateHz to
/// mostRateHz. A speed outside 0.001 to 100,000 mm/s is a fault, too. Faults of the forces: forces or a
/// coefficient that are implausible in every unit, no contact, lost contact, strokes in both directions. A tangential force or
/// coefficient of 0 throughout is a fault, too. Contact is lost where more than 1 % of the slide's samples have too small a
/// normal force: below leastShareOfLoad of the median, or below leastNormalN. A slide runs in both directions where each has more
/// than 5 % of its samples and both together have at least 80 % (directionsOf()). Where both together have less, there is a
/// warning; also for a result of fewer than shortestTrace samples.
PreparedRecord prepare(const RawRecord& record, const FrictionOptions& options);

/// Text with four significant figures.
std::string fourFigures(double value);

}  // namespace rendering::fabrics
