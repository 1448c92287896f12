// The part of a stroke that is the steady slide: without the approach, the breakaway from rest, the stop and
// everything after it. Also the samples that were taken without load.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace rendering::fabrics {

/// Rows from `begin` up to but not including `end`.
struct RowRange {
    std::size_t begin = 0, end = 0;
    std::size_t count() const { return end - begin; }
    bool operator==(const RowRange&) const = default;
};

/// A sample below this share of the median normal force has no contact.
inline constexpr double leastShareOfLoad = 0.25;

/// Shorter records are not analysed: the spread of so few samples has no meaning.
inline constexpr std::size_t fewestToAnalyse = 50;

/// Median of the loaded samples, which lie above half the 95th percentile of |force|.
double loadedLevel(std::span<const double> normalN);

/// At least ten samples without load at the beginning or the end of a record, whichever is longer. Their normal force stays
/// within a tenth of the way from rest to load. The tenth of them next to the contact is left out. Returns nullopt where
/// there are none, or where the force at rest exceeds a quarter of the load, which is not rest. Where less than 2 % of the
/// record is at rest, its ends give the level; an end at which the force rises or falls is an approach and no rest.
std::optional<RowRange> unloadedRows(std::span<const double> normalN);

struct Slide {
    RowRange contact, steady;  ///< `steady` lies in `contact`
    std::string why;           ///< where `steady` equals `contact`: the reason why nothing was cut
};

/// Contact is the longest run of samples above leastShareOfLoad; gaps of up to 1 % are bridged. Where the normal force is
/// unknown, contact is the whole record.
/// The steady part begins where coefficient and normal force stay within a band for a twentieth of the contact. It ends by
/// the same rule, read backwards. The band lies about the line through the middle half. Its half width is 1.25 times the
/// 99th percentile of the deviations there. It is at least a tenth (coefficient) or a fifth (force) of the level. Nothing
/// is cut from a record of fewer than fewestToAnalyse samples. Nothing is cut either where the beginning or the end would
/// lose more than 40 % of the contact.
Slide steadySlide(std::span<const double> normalN, std::span<const double> tangentialN);

/// How a slide divides between the two directions. Runs of five samples and more count whose force is larger than half the
/// median magnitude and keeps its sign. A reversal takes little time. So strokes back and forth give a sum near 1. Noise, waves
/// and drifts about 0 give at most 0.77.
struct StrokeDirections {
    double medianMagnitude = 0;
    double positive = 0, negative = 0;  ///< shares of all samples that lie in the runs
    RowRange longest;                   ///< the longest run
    std::size_t turn = 0;               ///< first row of the first run whose sign is not that of the first; 0 if there is none
};
StrokeDirections directionsOf(std::span<const double> signedForce);

}  // namespace rendering::fabrics
