#include "rendering/fabrics/drawn/drawn_dye.h"

#include <algorithm>
#include <cmath>

#include "rendering/fabrics/procedural/lattice_noise.h"

namespace rendering::fabrics {

namespace {

using protocols::Random;

constexpr std::uint64_t printLattice = 0x9A11, melangeLattice = 0x9A12;

Reflectance fromHue(double hue, double saturation, double value)
{
    Reflectance colour;
    for (int c = 0; c < 3; ++c) {
        const double place = std::fmod(hue * 6 + (c == 0 ? 0 : c == 1 ? 4 : 2), 6);
        const double share = std::clamp(std::abs(place - 3) - 1, 0.0, 1.0);
        colour[std::size_t(c)] = float(value * (1 - saturation + saturation * share));
    }
    return colour;
}

/// Black, dark, middle, pale and white fabrics are all common; saturated ones less so.
Reflectance drawColour(Random& random)
{
    const double kind = random.uniform();
    const double hue = random.uniform();
    if (kind < 0.12) return fromHue(hue, random.uniform(0, 0.5), random.uniform(0.012, 0.05));
    if (kind < 0.32) return fromHue(hue, random.uniform(0.2, 0.9), random.uniform(0.05, 0.2));
    if (kind < 0.62) return fromHue(hue, random.uniform(0.1, 0.95), random.uniform(0.2, 0.65));
    if (kind < 0.82) return fromHue(random.uniform(0.04, 0.16), random.uniform(0.1, 0.6), random.uniform(0.25, 0.8));
    return fromHue(hue, random.uniform(0, 0.25), random.uniform(0.6, 0.92));
}

/// Bands of 2 to 4 widths in turn; most are wide, some are lines of one or two yarns.
std::vector<std::uint8_t> drawBands(Random& random)
{
    std::vector<std::uint8_t> bands;
    const int number = 2 * (1 + int(random.below(3)));
    const double usual = 2 * std::exp(random.uniform() * std::log(25.0));
    for (int i = 0; i < number; ++i) {
        const int width =
            std::max(1, int(std::lround(random.uniform() < 0.25 ? random.uniform(1, 4) : usual * random.uniform(0.4, 1.6))));
        bands.insert(bands.end(), std::size_t(width), std::uint8_t(i % 2 == 0 ? 0 : 1 + random.below(2)));
    }
    return bands;
}

/// Colour index of a print at a place, mm: 0 for the ground, 1 or 2 for the figure.
int printedColour(const Dye& dye, std::uint64_t seed, double uMm, double vMm)
{
    const double x = uMm / dye.printMm, y = vMm / dye.printMm;
    const double cellX = x - std::floor(x) - 0.5, cellY = y - std::floor(y) - 0.5;
    switch (dye.printKind) {
        case 0:
            return cellX * cellX + cellY * cellY < 0.09 ? 1 : 0;
        case 1:
            return std::abs(cellX) < 0.22 ? 1 : std::abs(cellX) > 0.44 ? 2 : 0;
        case 2: {
            const NoisePair noise = noiseAt(seed ^ printLattice, float(1.7 * x), float(1.7 * y));
            return noise.first > 0.12f ? 1 : noise.second > 0.3f ? 2 : 0;
        }
        default:
            return (cellX < 0) == (cellY < 0) ? 1 : 0;
    }
}

Reflectance mixed(const Reflectance& a, const Reflectance& b, float share)
{
    Reflectance colour{};
    for (std::size_t c = 0; c < colour.size(); ++c) colour[c] = a[c] + share * (b[c] - a[c]);
    return colour;
}

std::uint8_t bandOf(const std::vector<std::uint8_t>& bands, std::int64_t yarn)
{
    const auto repeat = std::int64_t(bands.size());
    return bands[std::size_t(((yarn % repeat) + repeat) % repeat)];
}

}  // namespace

Dye drawDye(ClothKind kind, Random& random)
{
    Dye dye;
    for (Reflectance& colour : dye.colours) colour = drawColour(random);
    const bool woven = kind == ClothKind::Weave;
    const double choice = random.uniform();
    dye.unlevel = 0.01 + 0.05 * random.uniform() * random.uniform();
    dye.speckle = 0.02 + 0.22 * random.uniform() * random.uniform();
    dye.melange = 0;
    if (choice < 0.52)
        dye.kind = DyeKind::Plain;
    else if (choice < 0.64)
        dye.kind = woven ? DyeKind::TwoSystems : DyeKind::Plain;
    else if (choice < 0.72)
        dye.kind = DyeKind::Stripes;
    else if (choice < 0.79)
        dye.kind = woven ? DyeKind::Checks : DyeKind::Stripes;
    else if (choice < 0.89)
        dye.kind = DyeKind::Print;
    else
        dye.kind = DyeKind::Melange;
    if (dye.kind == DyeKind::Melange) dye.melange = random.uniform(0.1, 0.6);
    dye.warpBands = drawBands(random);
    dye.weftBands = random.uniform() < 0.5 ? dye.warpBands : drawBands(random);
    dye.printMm = 2 * std::exp(random.uniform() * std::log(20.0));
    dye.printKind = int(random.below(4));
    dye.printDepth = random.uniform(0.3, 1);
    return dye;
}

Reflectance dyedColour(const DrawnFabric& fabric, bool isWarp, std::int64_t yarn, double uMm, double vMm, bool isInDepth)
{
    const Dye& dye = fabric.dye;
    switch (dye.kind) {
        case DyeKind::Plain:
            return dye.colours[0];
        case DyeKind::TwoSystems:
            return dye.colours[isWarp ? 0 : 1];
        case DyeKind::Stripes:
            return isWarp ? dye.colours[bandOf(dye.warpBands, yarn)] : dye.colours[0];
        case DyeKind::Checks:
            return dye.colours[bandOf(isWarp ? dye.warpBands : dye.weftBands, yarn)];
        case DyeKind::Print:
            return mixed(dye.colours[0], dye.colours[std::size_t(printedColour(dye, fabric.seed, uMm, vMm))],
                         isInDepth ? float(dye.printDepth) : 1.f);
        case DyeKind::Melange: {
            const float along = float((isWarp ? vMm : uMm) / (3.1 * fabric.warp.spacingMm));
            const NoisePair noise = noiseAlong(fabric.seed ^ melangeLattice ^ (isWarp ? 1u : 2u), yarn, along);
            return mixed(dye.colours[0], dye.colours[1],
                         std::clamp(float(dye.melange) * (1 + noise.first) + 0.25f * noise.second, 0.f, 1.f));
        }
    }
    return dye.colours[0];
}

}  // namespace rendering::fabrics
