// Table of the procedural fabrics, in the terms of a textile engineer. A new fabric is a new row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace rendering::fabrics {

/// Yarn on top at every crossing of one repeat: ups[weft * warps + warp] is 1 where the warp is up.
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

/// Set of parallel yarns. Lengths in mm.
struct Yarns {
    double spacing = 0.5;
    double diameter = 0.45;
    double flatness = 0.6;     ///< height of the cross-section divided by its width
    double twistDegrees = 25;  ///< angle between the fibres and the axis of the yarn
    double unevenness = 0.06;  ///< relative change of diameter along the yarn
};

enum class Construction { Woven, Jersey, Rib, Corduroy };

/// Relief that is coarser than the yarns: cells of a waffle, pebbles of a crepe. Lengths in mm.
struct CellRelief {
    double depth = 0;
    double period = 1;
    bool regular = false;  ///< true: square cells with raised borders; false: irregular pebbles
};

struct Structure {
    std::string_view name;
    std::string_view structure;
    Construction construction = Construction::Woven;
    Draft draft;                   ///< woven fabrics, and the ground of a corduroy
    Yarns warp, weft;              ///< knits: spacing of wales and courses; the warp's diameter is the loop yarn's
    double crimpShare = 0.5;       ///< share of the crimp that the warp takes; the weft takes the rest
    double displacementMm = 0.03;  ///< irregularity of the yarns' positions
    double leno = 0;               ///< shift of a warp towards its pair, as a share of the spacing
    CellRelief cells;
    double pileMm = 0;                             ///< height of a corduroy's ribs; their period is cells.period
    double hairiness = 0.2;                        ///< 0 for filament to 1 for brushed fabrics
    double sheen = 0.1;                            ///< share of specular light
    double fibreFriction = 0.2;                    ///< adhesion part of the coefficient against the steel probe
    std::array<double, 3> colour{0.9, 0.9, 0.88};  ///< reflectance: red, green, blue
};

/// The fifteen structures; the first belongs to F01.
std::span<const Structure> allStructures();

}  // namespace rendering::fabrics
