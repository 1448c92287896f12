#include "rendering/fabrics/drawn/drawn_patch.h"

#include <algorithm>
#include <cmath>

#include "rendering/fabrics/drawn/drawn_friction.h"

namespace rendering::fabrics {

namespace {

constexpr double drawnFieldMm = 1000;  // Places are drawn from a square with this side.

}  // namespace

double drawPitch(const DrawnFabric& fabric, protocols::Random& random)
{
    const double period = threadPeriod(fabric).mm;
    const double pixels = 2 * std::exp(std::pow(random.uniform(), 1.35) * std::log(20.0));
    return std::clamp(period / pixels, 0.008, 0.5);
}

DrawnPatch drawPatchOf(const DrawnFabric& fabric, double meanFriction, std::uint64_t seed, std::uint64_t index,
                       const PatchOptions& options)
{
    protocols::Random random = protocols::Random::stream(seed, "drawn patch/" + std::to_string(index));
    DrawnPatch patch;
    patch.kind = fabric.kind;
    patch.meanFriction = meanFriction;
    patch.isFlat = random.uniform() < options.flatShare;
    patch.mmPerPixel = drawPitch(fabric, random);
    const FabricPlace place{random.uniform(0, drawnFieldMm), random.uniform(0, drawnFieldMm), random.uniform(0, 360)};
    const ClothCamera camera = drawCamera(patch.isFlat, random);
    patch.lightDeg = lightSide(camera);
    ClothPhotograph photograph =
        photographCloth(fabric, place, {options.pixels, options.pixels}, patch.mmPerPixel, camera, random);
    patch.rgb = photograph.rgb;
    patch.heightMm = photograph.heightMm;
    patch.textureSqMm = photograph.textureSqMm;
    patch.periodPx = threadPeriod(fabric).mm / patch.mmPerPixel;
    return patch;
}

DrawnPatch drawPatch(std::uint64_t seed, std::uint64_t index, const PatchOptions& options)
{
    const DrawnFabric fabric = drawFabric(seed, index);
    return drawPatchOf(fabric, meanFriction(fabric), seed, index, options);
}

}  // namespace rendering::fabrics
