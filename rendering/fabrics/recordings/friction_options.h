// How a friction record is taken over: which axes its forces are, where nothing touched, which part is the
// slide, and at what rate it is kept. What was done is stated, and saved beside the record.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::fabrics {

/// A column of forces, turned round where `sign` is -1.
struct Axis {
    std::string column;
    int sign = 1;
    bool operator==(const Axis&) const = default;
};

/// Seconds after the record's first stamp.
struct Interval {
    double fromS = 0, toS = 0;
    bool operator==(const Interval&) const = default;
};

enum class Found { Automatically, Not, AsStated };

struct FrictionOptions {
    std::optional<Axis> normal;         ///< none: found by name
    std::vector<Axis> tangential;       ///< one keeps its sign, two are taken together as sqrt(x^2 + y^2); none: by name
    std::string forceUnit;              ///< of columns that state none: "N", "mN", "gf", ...; empty: N
    Found zero = Found::Automatically;  ///< unloaded samples, whose mean is subtracted from every force
    Interval zeroInterval;              ///< where zero is AsStated
    Found trim = Found::Automatically;  ///< the steady slide
    Interval trimInterval;              ///< where trim is AsStated
    std::optional<double> rateHz;       ///< none: the median of the record's own steps
};

/// "auto", "none" or "FROM,TO" in seconds. Throws badInput naming `option`.
Found foundFrom(std::string_view text, std::string_view option, Interval& interval);

/// "[-]NAME[,[-]NAME]"; empty: none. Throws badInput naming `option` for more than `most` or an empty name.
std::vector<Axis> axesFrom(std::string_view text, std::string_view option, std::size_t most);

/// Newtons in a unit of force (or in a gram's weight); none for an unknown one. Letter case is ignored.
std::optional<double> newtonsIn(std::string_view unit);

/// For messages.
inline constexpr std::string_view knownForceUnits = "N, mN, uN, kN, gf, kgf (or g, kg)";

}  // namespace rendering::fabrics
