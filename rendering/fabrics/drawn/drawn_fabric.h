// A fabric that no table holds: its construction is drawn from a seed and an index. Weaves, knits and piles, their yarns, fibre,
// dye and slack. The struct describes the construction; cloth_window samples its surface, cloth_camera photographs it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rendering/fabrics/drawn/weave_draft.h"
#include "rendering/fabrics/fibre.h"

namespace rendering::fabrics {

enum class ClothKind { Weave, Jersey, Rib, Interlock, Purl, CutPile, Terry, Corduroy, Fleece };

/// A set of parallel yarns. Knits: `warp` has the spacing of the wales and the loop yarn, `weft` the spacing of the courses.
struct DrawnYarns {
    double spacingMm = 0.5;  ///< 0.15 to 3
    double diameterMm = 0.45;
    double flatness = 0.6;       ///< height of the cross-section divided by its width
    double twistDegrees = 25;    ///< angle between fibres and axis; negative for S twist
    int plies = 1;               ///< 1 to 3
    double unevenness = 0.08;    ///< relative standard deviation of the diameter along and between yarns
    double displacement = 0.05;  ///< standard deviation of a yarn's place, as a share of the spacing
    double looseShare = 0;       ///< share of yarns that stand out
    double missingShare = 0;     ///< share of yarns that are missing
    double spread = 0;           ///< widening of a float, as a share of the diameter
};

/// Pile, loops or nap above the ground. Lengths in mm.
struct DrawnPile {
    double heightMm = 0;
    double spacingMm = 1;    ///< between tufts, loops or locks; for corduroy between rows along a rib
    double lengthMm = 1;     ///< of a fibre bundle that lies down
    double widthMm = 0.2;    ///< of a tuft, loop yarn or lock
    double order = 0.5;      ///< 0: every direction; 1: all lie along the nap
    double napDegrees = 0;   ///< direction of the nap
    double ribPeriodMm = 2;  ///< corduroy
    double ribShare = 0.8;   ///< corduroy: width of a rib divided by its period
};

enum class DyeKind { Plain, TwoSystems, Stripes, Checks, Print, Melange };
using Reflectance = std::array<float, 3>;  ///< linear red, green, blue in [0, 1]

/// Dye is independent of the relief.
struct Dye {
    DyeKind kind = DyeKind::Plain;
    std::array<Reflectance, 3> colours{};
    std::vector<std::uint8_t> warpBands, weftBands;  ///< colour of each yarn of one repeat
    double printMm = 10;                             ///< size of a print's figure
    int printKind = 0;                               ///< 0 dots, 1 stripes, 2 patches, 3 checks
    double printDepth = 1;                           ///< share of the colour that reaches the lower half of the yarns
    double melange = 0;                              ///< share of fibres of the second colour
    double speckle = 0.05;                           ///< relative variation of the shade within yarns, from dye and fibres
    double unlevel = 0.02;                           ///< relative standard deviation of the shade between yarns
};

/// Free cloth neither lies flat nor hangs straight.
struct Slack {
    double waveMm = 0, waveLengthMm = 30;      ///< slow undulation
    double creaseMm = 0, creaseLengthMm = 25;  ///< ridges where the cloth was folded
    double wanderMm = 0, wanderLengthMm = 8;   ///< displacement of the threads within the plane
    double skewDegrees = 0;                    ///< departure of weft or courses from the right angle
};

struct DrawnFabric {
    std::uint64_t seed = 0;  ///< of all irregularity; places of one fabric agree everywhere
    ClothKind kind = ClothKind::Weave;
    Fibre fibre = Fibre::Cotton;
    NamedDraft weave;
    DrawnYarns warp, weft;
    double crimpShare = 0.5;  ///< share of the crimp that the warp takes
    double looseness = 1;     ///< depth of the relief against that of rigid, touching yarns
    DrawnPile pile;
    Dye dye;
    Slack slack;
    double hairiness = 0.2;  ///< 0 filament to 1 brushed
    double sheen = 0.1;      ///< share of light that the fibres mirror
    double adhesion = 0.2;   ///< coefficient of the fibre on smooth skin or steel, at 15 N
    double unseen = 1;       ///< factor of the coefficient that no photograph shows: finish, softener, humidity
};

/// Draws construction `index` of the family `seed`. Equal arguments give the same fabric.
DrawnFabric drawFabric(std::uint64_t seed, std::uint64_t index);

std::string nameOf(ClothKind kind);
/// The construction in words: "twill 2/2, 0.40 × 0.46 mm, wool, napped".
std::string inWords(const DrawnFabric& fabric);

/// Spacing of the threads or tufts that show most, mm, and the direction across them on the fabric, degrees from its x axis.
struct ThreadPeriod {
    double mm = 1;
    double degrees = 0;
};
ThreadPeriod threadPeriod(const DrawnFabric& fabric);

}  // namespace rendering::fabrics
