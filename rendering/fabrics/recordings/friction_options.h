// Options for the import of a friction record: the axes of its forces, the unloaded samples, the steady slide and the
// sampling rate. The import saves the choices that it made beside the record.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/fabrics/friction_record.h"

namespace rendering::fabrics {

/// Column of forces; a `sign` of -1 reverses its direction.
struct ForceAxis {
    std::string column;
    int sign = 1;
    bool operator==(const ForceAxis&) const = default;
};

/// Seconds after the first stamp of the record.
struct TimeInterval {
    double fromS = 0, toS = 0;
    bool operator==(const TimeInterval&) const = default;
};

enum class Selection { Automatic, None, Stated };

struct FrictionOptions {
    std::optional<ForceAxis> normal;        ///< nullopt: found by name
    std::vector<ForceAxis> tangential;      ///< one keeps its sign, two are combined as sqrt(x^2 + y^2); empty: found by name
    std::string forceUnit;                  ///< for columns that state no unit: "N", "mN", "gf" and others; empty: N
    Selection zero = Selection::Automatic;  ///< unloaded samples, whose mean is subtracted from every force
    TimeInterval zeroInterval;              ///< used where `zero` is Stated
    Selection trim = Selection::Automatic;  ///< the steady slide
    TimeInterval trimInterval;              ///< used where `trim` is Stated
    std::optional<double> rateHz;           ///< nullopt: the median step of the record
};

/// Bounds of a sample rate in Hz: of a record's own, and of the one that the options state.
inline constexpr double leastRateHz = leastRecordHz, mostRateHz = 1e7;

/// Reads "auto", "none" or "FROM,TO" in seconds. Throws badInput naming `option`.
Selection selectionFrom(std::string_view text, std::string_view option, TimeInterval& interval);

/// Reads "[-]NAME[,[-]NAME]"; empty text gives no axes. Throws badInput naming `option` for more than `most` or an empty name.
std::vector<ForceAxis> axesFrom(std::string_view text, std::string_view option, std::size_t most);

/// Newtons per unit of force, or per weight of a gram or kilogram; nullopt for an unknown unit. Letter case is ignored.
std::optional<double> newtonsIn(std::string_view unit);

/// List of the units for messages.
inline constexpr std::string_view knownForceUnits = "N, mN, uN, kN, gf, kgf (or g, kg)";

}  // namespace rendering::fabrics
