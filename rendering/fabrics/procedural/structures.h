// The fabrics of the procedural data set as a table: what a textile engineer would note down of each.
// Adding a fabric is adding a row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace rendering::fabrics {

/// Which yarn lies on top at every crossing of one repeat: ups[weft][warp] is true where the warp is up.
struct Draft {
    int warps = 0;
    int wefts = 0;
    std::vector<std::uint8_t> ups;
    bool warpIsUp(std::int64_t warp, std::int64_t weft) const
    {
        const auto column = ((warp % warps) + warps) % warps;
        const auto row = ((weft % wefts) + wefts) % wefts;
        return ups[std::size_t(row * warps + column)] != 0;
    }
};

/// A set of parallel yarns. Lengths in mm.
struct Yarns {
    double spacing = 0.5;
    double diameter = 0.45;
    double flatness = 0.6;     ///< height of the cross-section over its width
    double twistDegrees = 25;  ///< angle of the fibres to the yarn's axis
    double unevenness = 0.06;  ///< relative change of diameter along the yarn
};

enum class Construction { Woven, Jersey, Rib, Corduroy };

/// Bumps of a size above the yarns': cells of a waffle, pebbles of a crepe. Lengths in mm.
struct Cells {
    double depth = 0;
    double period = 1;
    bool regular = false;  ///< square cells with raised borders, else irregular pebbles
};

struct Structure {
    std::string_view name;
    std::string_view structure;
    Construction construction = Construction::Woven;
    Draft draft;                   ///< woven ones, and the ground of a corduroy
    Yarns warp, weft;              ///< of a knit: wale and course spacing; the warp's diameter is the loop yarn's
    double crimpShare = 0.5;       ///< how much of the crimp the warp takes; the weft takes the rest
    double displacementMm = 0.03;  ///< irregular place of the yarns
    double leno = 0;               ///< shift of warps towards their pair, as part of the spacing
    Cells cells;
    double pileMm = 0;                             ///< height of a corduroy's ribs; their period is cells.period
    double hairiness = 0.2;                        ///< 0 filament .. 1 brushed
    double sheen = 0.1;                            ///< share of mirrored light
    double fibreFriction = 0.2;                    ///< adhesion part of the coefficient against the steel probe
    std::array<double, 3> colour{0.9, 0.9, 0.88};  ///< reflectance, R G B
};

/// The fifteen, F01 first.
std::span<const Structure> allStructures();

}  // namespace rendering::fabrics
