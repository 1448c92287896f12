#include "rendering/models/seeing/cloth_batches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/random.h"
#include "rendering/fabrics/drawn/drawn_friction.h"
#include "rendering/fabrics/drawn/drawn_patch.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/seeing/friction_target.h"
#include "rendering/models/seeing/pitch_unit.h"
#include "rendering/models/seeing/told_lamp.h"

namespace rendering::models {

namespace {

using protocols::Random;

constexpr double strokeFieldMm = 900;  ///< Strokes start in a square with this side.

/// Photographed cloth with its relief, before it is copied into a batch.
struct KnownPatch {
    cv::Mat rgb;       ///< CV_8UC3
    cv::Mat reliefPx;  ///< CV_32FC1
    double mmPerPixel = 0.05;
    float logFriction = std::numeric_limits<float>::quiet_NaN();
    std::optional<double> lightDeg = {};
    cv::Mat logRatio = {};  ///< empty for scans
    std::optional<fabrics::Fibre> fibre = {};
};

cv::Mat linearReflectance(const cv::Mat& srgb)
{
    cv::Mat table(1, 256, CV_32F), linear;
    for (int i = 0; i < 256; ++i) {
        const double value = i / 255.0;
        table.at<float>(i) = static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    cv::LUT(srgb, table, linear);
    return linear;
}

/// Spectrogram of a stroke elsewhere on the fabric, in a direction of its own.
cv::Mat strokeElsewhere(const fabrics::DrawnFabric& fabric, double mean, Random& random, const Architecture& architecture)
{
    const fabrics::FabricPlace start{random.uniform(0, strokeFieldMm), random.uniform(0, strokeFieldMm), random.uniform(0, 360)};
    const fabrics::ForceRecord record = fabrics::strokeDrawn(fabric, mean, start, {}, random);
    std::vector<double> trace;
    for (std::size_t i = 0; i < record.timeS.size(); ++i) trace.push_back(record.tangentialN[i] / record.normalN[i]);
    return frictionTarget(trace, architecture).logRatio;
}

KnownPatch drawnPatch(std::uint64_t seed, std::uint64_t index, const ClothBatchOptions& options)
{
    const fabrics::DrawnFabric fabric = fabrics::drawFabric(seed, index);
    const double friction = fabrics::meanFriction(fabric);
    const fabrics::DrawnPatch drawn = fabrics::drawPatchOf(fabric, friction, seed, index, {options.side, options.flatShare});
    Random random = Random::stream(seed, "stroke/" + std::to_string(index));
    return {drawn.rgb,        drawn.heightMm / drawn.mmPerPixel,
            drawn.mmPerPixel, static_cast<float>(std::log(friction)),
            drawn.lightDeg,   strokeElsewhere(fabric, friction, random, options.spectrograms),
            fabric.fibre};
}

/// Zoom of scanned cloth: a larger one shows fewer, larger threads. Slopes stay, so heights grow with the picture.
constexpr double smallestZoom = 0.5, largestZoom = 2;
constexpr int cameraBorderPx = 8;
/// Pictures that are taken as they are keep their sharpness, so half of them are not zoomed at all.
constexpr double unzoomedShare = 0.5, largestPictureZoom = 1.5;

/// A part of scanned cloth, zoomed to a square of `side` px.
struct ScanPart {
    cv::Rect rect;
    int side = 0;
    void zoom(const cv::Mat& from, cv::Mat& to) const
    {
        if (rect.width == side)
            from(rect).copyTo(to);
        else
            cv::resize(from(rect), to, {side, side}, 0, 0, rect.width > side ? cv::INTER_AREA : cv::INTER_CUBIC);
    }
};

/// `shrink`: pixels of the scan that become one.
ScanPart partOf(const ScannedCloth& scan, int side, double shrink, Random& random)
{
    const int taken = std::min({static_cast<int>(std::ceil(side * shrink)), scan.rgb.cols, scan.rgb.rows});
    const auto start = [&](int length) { return static_cast<int>(random.below(static_cast<std::uint64_t>(length - taken) + 1)); };
    const int x = start(scan.rgb.cols), y = start(scan.rgb.rows);
    return {{x, y, taken, taken}, side};
}

double drawnShrink(const ScannedCloth& scan, int side, double largest, Random& random)
{
    const double most = std::min({largest, scan.rgb.cols / (side + 2.0), scan.rgb.rows / (side + 2.0)});
    return std::exp(random.uniform(-std::log(largest), std::log(std::max(1 / largest, most))));
}

/// The colour of scanned cloth under the lamps and in the camera of drawn fabrics.
KnownPatch photographedAnew(const ScannedCloth& scan, const ClothBatchOptions& options, Random& random)
{
    const int side = options.side + 2 * cameraBorderPx;
    const ScanPart part = partOf(scan, side, drawnShrink(scan, side, 1 / smallestZoom, random), random);
    cv::Mat reflectance, height;
    part.zoom(linearReflectance(scan.rgb), reflectance);
    part.zoom(scan.heightMm, height);
    const int symmetry = static_cast<int>(random.below(8));
    const double pitch = scan.mmPerPixel * part.rect.width / side;
    const fabrics::ClothCamera camera = fabrics::drawCamera(random.uniform() < options.flatShare, random);
    const fabrics::ClothWindow window = fabrics::windowOf(turned(height, symmetry), cv::max(turned(reflectance, symmetry), 0));
    const fabrics::ClothPhotograph photograph = fabrics::photographWindow(window, pitch, cameraBorderPx, camera, random);
    KnownPatch patch{photograph.rgb, photograph.heightMm / pitch, pitch};
    patch.lightDeg = fabrics::lightSide(camera);
    return patch;
}

/// A part of the picture as it is, turned.
KnownPatch takenAsItIs(const ScannedCloth& scan, const ClothBatchOptions& options, Random& random)
{
    const double shrink = random.uniform() < unzoomedShare ? 1 : drawnShrink(scan, options.side, largestPictureZoom, random);
    const ScanPart part = partOf(scan, options.side, shrink, random);
    KnownPatch patch;
    cv::Mat height;
    part.zoom(scan.rgb, patch.rgb);
    part.zoom(scan.heightMm, height);
    patch.mmPerPixel = scan.mmPerPixel * part.rect.width / options.side;
    const int symmetry = static_cast<int>(random.below(8));
    patch.rgb = turned(patch.rgb, symmetry);
    patch.reliefPx = turned(height, symmetry) / patch.mmPerPixel;
    if (scan.lightDeg) patch.lightDeg = sideAfter(*scan.lightDeg, symmetry);
    return patch;
}

KnownPatch scannedPatch(const std::vector<ScannedCloth>& scans, const ClothBatchOptions& options, Random& random)
{
    if (random.uniform() >= options.anewShare) return takenAsItIs(scans[random.below(scans.size())], options, random);
    const ScannedCloth* flat = nullptr;  // readScannedCloth() returns at least one.
    do flat = &scans[random.below(scans.size())];
    while (!flat->isFlat);
    return photographedAnew(*flat, options, random);
}

/// Pieces of both maps are cut at one place, and one missing height would spoil the training.
void requireOfOneSize(const cv::Mat& surface, const cv::Mat& rgb, const std::filesystem::path& file)
{
    if (surface.size() != rgb.size())
        throw protocols::badInput(
            {"the surface has " + std::to_string(surface.cols) + " x " + std::to_string(surface.rows) + " px", file.string(),
             "the " + std::to_string(rgb.cols) + " x " + std::to_string(rgb.rows) + " px of its photograph",
             "scale it to the photograph, or remove it"});
    if (!cv::checkRange(surface))
        throw protocols::badInput({"holds heights that are not finite", file.string(), "a number in every pixel",
                                   "fill the gaps, or remove the surface"});
}

}  // namespace

void copyPhotograph(const cv::Mat& rgb, float* out)
{
    const std::size_t pixels = rgb.total();
    for (int y = 0; y < rgb.rows; ++y)
        for (int x = 0; x < rgb.cols; ++x) {
            const auto& pixel = rgb.at<cv::Vec3b>(y, x);
            for (std::size_t c = 0; c < 3; ++c)
                out[c * pixels + static_cast<std::size_t>(y * rgb.cols + x)] =
                    static_cast<float>(pixel[static_cast<int>(c)]) / 255;
        }
}

std::vector<ScannedCloth> readScannedCloth(const fabrics::Dataset& dataset, const std::vector<protocols::FabricId>& heldOut,
                                           const PictureSet& leftOut)
{
    const fabrics::PhotographViews views(dataset);
    std::vector<ScannedCloth> scans;
    for (const fabrics::SamplePlace& place : fabrics::readSamplePlaces(dataset)) {
        if (place.modality != fabrics::Modality::Visual ||
            std::find(heldOut.begin(), heldOut.end(), place.fabric) != heldOut.end() ||
            leftOut.contains({place.fabric, place.index}) || !dataset.fabric(place.fabric).surfaceInMm)
            continue;
        const auto surface = fabrics::readSurface(dataset, place.fabric, place.index);
        const auto pitch = views.mmPerPixel(place.fabric, place.index);
        if (!surface || !pitch) continue;
        const cv::Mat rgb = fabrics::readPhotograph(dataset, place.fabric, place.index);
        requireOfOneSize(*surface, rgb, fabrics::surfacePath(dataset, place.fabric, place.index));
        scans.push_back(
            {place.fabric.value, rgb, *surface, *pitch, place.light == "colour", place.lightDeg,
             protocols::sha256OfFile(fabrics::samplePath(dataset, place.fabric, fabrics::Modality::Visual, place.index))});
    }
    if (std::ranges::none_of(scans, &ScannedCloth::isFlat))
        throw protocols::badInput({"no scanned cloth remains for training", dataset.folder.string(),
                                   "pictures with light \"colour\", a surface in mm and a scale, of cloth that is not held out",
                                   leftOut.empty() ? "make the data set with `vis2hap import scans`"
                                                   : "name scans of cloth that the lab does not hold out, or leave --scans out"});
    return scans;
}

std::vector<std::string> hashesOf(const std::vector<ScannedCloth>& scans)
{
    std::vector<std::string> hashes;
    for (const ScannedCloth& scan : scans) hashes.push_back(scan.sha256);
    return hashes;
}

ClothBatch drawClothBatch(const std::vector<ScannedCloth>& scans, const ClothBatchOptions& options, std::uint64_t seed,
                          std::uint64_t number)
{
    Random random = Random::stream(seed, "cloth batch/" + std::to_string(number));
    const auto pixels = static_cast<std::size_t>(options.side) * static_cast<std::size_t>(options.side);
    const auto size = static_cast<std::size_t>(options.size), first = static_cast<std::size_t>(options.firstRow);
    const auto rows = static_cast<std::size_t>(options.rows.value_or(options.size - options.firstRow));
    ClothBatch batch;
    batch.size = static_cast<int>(rows);
    batch.side = options.side;
    batch.photographs.resize(3 * pixels * rows);
    batch.reliefs.resize(pixels * rows);
    for (std::size_t i = 0; i < size; ++i) {
        const bool scanned = !scans.empty() && random.uniform() < options.scanShare;
        const bool isWanted = i >= first && i < first + rows;
        if (!isWanted && !scanned) {
            random.uniform();  // Of the lamp below. A drawn patch has a stream of its own, so it need not be drawn.
            continue;
        }
        const KnownPatch patch = scanned ? scannedPatch(scans, options, random) : drawnPatch(seed, number * size + i, options);
        const ToldLamp lamp = random.uniform() < options.toldShare ? toldLamp(patch.lightDeg) : ToldLamp{};
        if (!isWanted) continue;
        batch.lamps.insert(batch.lamps.end(), lamp.numbers.begin(), lamp.numbers.end());
        copyPhotograph(turned(patch.rgb, lamp.turn), batch.photographs.data() + 3 * pixels * (i - first));
        cv::Mat relief(options.side, options.side, CV_32F, batch.reliefs.data() + pixels * (i - first));
        cv::subtract(turned(patch.reliefPx, lamp.turn), cv::mean(patch.reliefPx), relief);
        batch.logPitches.push_back(static_cast<float>(std::log(patch.mmPerPixel / pitchUnitMm)));
        batch.logFrictions.push_back(patch.logFriction);
        batch.fibres.push_back(patch.fibre);
        const std::size_t cells = std::size_t(options.spectrograms.rows) * std::size_t(options.spectrograms.frames);
        if (patch.logRatio.empty())
            batch.logRatios.insert(batch.logRatios.end(), cells, std::numeric_limits<float>::quiet_NaN());
        else
            batch.logRatios.insert(batch.logRatios.end(), patch.logRatio.begin<float>(), patch.logRatio.end<float>());
    }
    return batch;
}

}  // namespace rendering::models
