// What the renderings of a condition cost and what they gave up, over the fabrics of a study. `study new` measures it where a
// condition carries a quality. It names conditions, so only reports of an unblinded study show it.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "stats/kernels/value.h"

namespace reports {

/// In the order of the table: from the time to the finger.
enum class PriceMeasure {
    Milliseconds,
    ReliefError,
    FrictionError,
    HeightSpectrum,
    MeanFrictionError,
    FeltDifference,
    FeltTexture,
    FeltSlipperiness,
    FeltFromMeasured,
};

struct PriceMeasureRow {
    PriceMeasure measure;
    const char* field;    ///< in JSON; its interval has the same name with _ci95
    const char* heading;  ///< in tables, with its unit
    int decimals;         ///< in tables
};

inline constexpr std::array<PriceMeasureRow, 9> priceMeasureRows{{
    {PriceMeasure::Milliseconds, "milliseconds", "time, ms", 1},
    {PriceMeasure::ReliefError, "relief_error_percent", "relief error, %", 2},
    {PriceMeasure::FrictionError, "friction_error_percent", "friction error, %", 2},
    {PriceMeasure::HeightSpectrum, "height_spectrum_db", "height spectrum from measured, dB", 2},
    {PriceMeasure::MeanFrictionError, "mean_friction_error_percent", "mean friction from measured, %", 2},
    {PriceMeasure::FeltDifference, "felt_difference_jnd", "felt difference, JND", 2},
    {PriceMeasure::FeltTexture, "felt_texture_jnd", "of texture, JND", 2},
    {PriceMeasure::FeltSlipperiness, "felt_slipperiness_jnd", "of slipperiness, JND", 2},
    {PriceMeasure::FeltFromMeasured, "felt_from_measured_jnd", "felt difference from measured, JND", 2},
}};

inline const PriceMeasureRow& rowOf(PriceMeasure measure) { return priceMeasureRows[static_cast<std::size_t>(measure)]; }

/// Mean over fabrics with Student's interval; of times the median with the interval of order statistics.
struct PriceFact {
    stats::Value value;
    stats::Interval ci95;
    bool operator==(const PriceFact&) const = default;
};

struct RenderingPrice {
    std::string condition;      ///< "h_g@fast"
    std::string row;            ///< "h_g": renderings of one row differ in quality only
    std::string quality;        ///< "fast", "balanced" or "accurate"
    std::string settings;       ///< a JSON object of the settings that the quality stands for
    bool usualQuality = false;  ///< the condition's id carries no quality
    std::size_t fabrics = 0;
    std::array<PriceFact, priceMeasureRows.size()> facts;

    PriceFact& operator[](PriceMeasure measure) { return facts[static_cast<std::size_t>(measure)]; }
    const PriceFact& operator[](PriceMeasure measure) const { return facts[static_cast<std::size_t>(measure)]; }
    bool operator==(const RenderingPrice&) const = default;
};

}  // namespace reports
