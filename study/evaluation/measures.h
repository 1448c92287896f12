// Measures of a pair of generated and measured signals, as one table with names, units and averaging.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "stats/kernels/value.h"

namespace study::evaluation {

enum class Measure {
    FrictionMae,
    FrictionMaeOverMean,
    MeanFrictionError,
    FrictionSpectrum,
    FrictionCovered,
    Ssim,
    SsimNormalised,
    SsimRegistered,
    HeightSpectrum,
    SqRatio,
    SdrRatio,
    SalRatio,
    IdentifiedByHeight,
    IdentifiedByFriction,
    IdentifiedByBoth,
    MeanFriction,
    SqMm,
};
inline constexpr std::size_t measureCount = 17;

enum class Section { Friction, Height, Roughness, Identification, Level };
enum class Averaging { Arithmetic, Geometric };
enum class Better { Smaller, Larger, NearOne, Neither };
enum class NumberFormat { Plain4, Percent, Decibels, Ratio };

struct MeasureRow {
    Measure measure;
    Section section;
    std::string_view field;    ///< name in JSON
    std::string_view heading;  ///< heading in tables
    NumberFormat format;
    Averaging averaging;
    Better better;
    std::string_view meaning;  ///< explanation in one line
};

/// All measures, in the order of the enumeration.
const std::array<MeasureRow, measureCount>& measureTable();
const MeasureRow& rowOf(Measure measure);

using Values = std::array<stats::Value, measureCount>;
using Intervals = std::array<stats::Interval, measureCount>;

inline stats::Value& at(Values& values, Measure measure) { return values[static_cast<std::size_t>(measure)]; }
inline const stats::Interval& at(const Intervals& intervals, Measure measure)
{
    return intervals[static_cast<std::size_t>(measure)];
}
inline const stats::Value& at(const Values& values, Measure measure) { return values[static_cast<std::size_t>(measure)]; }

}  // namespace study::evaluation
