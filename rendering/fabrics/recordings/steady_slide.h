// Which part of a stroke is the slide: without the approach, the breakaway from rest, the stop and what
// follows; and which samples were taken while nothing touched.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rendering::fabrics {

/// Rows from `begin` to before `end`.
struct Rows {
    std::size_t begin = 0, end = 0;
    std::size_t count() const { return end - begin; }
    bool operator==(const Rows&) const = default;
};

/// Below this share of the median normal force a sample is no contact.
inline constexpr double leastShareOfLoad = 0.25;

/// Records shorter than this are not judged: a spread of so few samples says nothing.
inline constexpr std::size_t fewestToJudge = 50;

/// Median of the loaded samples: those above half the 95th percentile of |force|.
double loadedLevel(std::span<const double> normalN);

/// Ten or more samples at the beginning or end of a record (the longer of the two) whose normal force
/// stays within a tenth of the way from rest to load, but for the tenth of them next to the contact; none where there are no
/// such, or where rest is more than a quarter of the load: then it was no rest.
std::optional<Rows> unloadedRows(std::span<const double> normalN);

struct Slide {
    Rows contact, steady;  ///< `steady` lies in `contact`
    std::string why;       ///< where `steady` is all of `contact`: why nothing was cut
};

/// Contact is the longest run of samples above leastShareOfLoad (of all of them where no normal force is
/// known; gaps of up to 1 % are bridged). The steady part begins when coefficient and normal force have
/// stayed for a twentieth of the contact within a band about the line through the middle half: 1.25 times
/// what 99 % of it stray, at least a tenth (coefficient) or a fifth (force); and ends likewise. Values without
/// a normal force are judged alone. Nothing is cut from a record of fewer than fewestToJudge samples, nor
/// where the beginning or the end would lose more than 40 % of the contact.
Slide steadySlide(std::span<const double> normalN, std::span<const double> tangentialN);

}  // namespace rendering::fabrics
