#include "rendering/scans/import_scans.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/random.h"
#include "rendering/fabrics/recordings/import_stage.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"
#include "rendering/scans/relighting.h"
#include "rendering/signals/repeated_place.h"

namespace rendering::scans {

namespace {

using protocols::FabricId;
using protocols::Sync;

/// A photograph of the whole tile and how it was lit.
struct LitTile {
    const char* light;
    std::optional<double> sideDeg;
    cv::Mat rgb;
};

std::vector<LitTile> litTiles(const Scan& scan)
{
    std::vector<LitTile> tiles{{oneLampName, oneLampDeg, relit(scan, oneLampDeg)}};
    for (const double side : fourLampsDeg) tiles.push_back({fourLampsName, side, relit(scan, side)});
    tiles.push_back({colourName, std::nullopt, scan.colour});
    return tiles;
}

/// Which of the four lamps lights a patch: each as often, in an order drawn for the fabric.
std::vector<std::size_t> lampsFor(const std::string& fabric, std::size_t patches)
{
    std::vector<std::size_t> lamps;
    for (std::size_t i = 0; i < patches; ++i) lamps.push_back(i % std::size(fourLampsDeg));
    protocols::Random::stream(1, "lamp of a scan/" + fabric).shuffle(lamps);
    return lamps;
}

void writePatch(fabrics::ImportStage& stage, const FabricId& fabric, const Scan& scan, const Patch& patch, const LitTile& tile,
                const std::string& group)
{
    const cv::Rect& at = patch.place;
    fabrics::SamplePlace place{fabric,
                               fabrics::Modality::Visual,
                               0,
                               (at.x + at.width / 2.0) * scan.mmPerPixel,
                               (at.y + at.height / 2.0) * scan.mmPerPixel,
                               0,
                               group};
    place.mmPerPixel = scan.mmPerPixel;
    place.light = tile.light;
    place.lightDeg = tile.sideDeg;
    const auto slot = stage.addPhotograph(place);
    writePng(slot.file, tile.rgb(at).clone(), Sync::Later);
    writeTiff(stage.surfaceOf(fabric, slot), scan.surface(at).clone(), Sync::Later);
}

std::string copyText(const signals::RepeatedPlace& copy)
{
    return "the same place stands " + std::to_string(copy.rightPx) + " px to the right and " + std::to_string(copy.downPx) +
           " px below (match " + protocols::fixed(copy.match, 2) + ", " + protocols::fixed(100 * copy.share, 1) +
           " % of the tile), so no split divides this fabric by place";
}

/// Writes the patches of one fabric and returns what there is to say about it.
std::vector<std::string> writeFabric(fabrics::ImportStage& stage, const ScanFiles& files, const Scan& scan, const TileWidth& tile,
                                     int sidePx)
{
    const FabricId fabric = stage.fabricFor(files.name, std::nullopt);
    for (auto& info : stage.dataset().fabrics)
        if (info.id == fabric) info.surfaceInMm = scan.surfaceInMm;
    const auto copy = signals::repeatedPlace(scan.surface);
    const auto patches = patchesOf(scan.surface.size(), sidePx);
    const auto tiles = litTiles(scan);
    const auto lamps = lampsFor(files.name, patches.size());
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const std::string group = fabric.value + (copy ? "/tile" : "/band/" + std::to_string(patches[i].band));
        for (const std::size_t light : {std::size_t{0}, 1 + lamps[i], tiles.size() - 1})
            writePatch(stage, fabric, scan, patches[i], tiles[light], group);
    }
    const std::string head = fabric.value + " " + files.name + ": ";
    std::vector<std::string> lines{head + std::to_string(patches.size()) + " places in " +
                                   std::to_string(patches.back().band + 1) +
                                   " bands, 3 photographs each (one_lamp, four_lamps, colour), " + std::to_string(sidePx) +
                                   " x " + std::to_string(sidePx) + " px, " + protocols::fixed(scan.mmPerPixel, 4) +
                                   " mm per pixel (tile " + protocols::fixed(tile.mm, 1) + " mm, " + tile.source + ")"};
    if (scan.surfaceInMm) {
        cv::Scalar mean, spread;
        cv::meanStdDev(scan.surface, mean, spread);
        lines.push_back(head + "surface of the free cloth, Sq " + protocols::fixed(1000 * spread[0], 0) + " um over the tile");
    }
    for (const std::string& remark : scan.remarks) lines.push_back(head + remark);
    if (copy) lines.push_back(head + copyText(*copy));
    return lines;
}

/// "2 images were left out WHY: a.png, b.png"; no line where there are none.
std::vector<std::string> leftOutLines(const std::vector<std::filesystem::path>& files, const std::string& why)
{
    constexpr std::size_t mostNames = 8;
    if (files.empty()) return {};
    std::string line = std::to_string(files.size()) + (files.size() == 1 ? " image was" : " images were") + " left out " + why;
    for (std::size_t i = 0; i < std::min(mostNames, files.size()); ++i)
        line += (i == 0 ? ": " : ", ") + files[i].filename().string();
    if (files.size() > mostNames) line += " and " + std::to_string(files.size() - mostNames) + " more";
    return {line};
}

bool hasSurfaces(const fabrics::Dataset& dataset)
{
    return std::any_of(dataset.fabrics.begin(), dataset.fabrics.end(), [&](const fabrics::FabricInfo& fabric) {
        return std::filesystem::exists(dataset.folder / fabric.id.value / "surface");
    });
}

void requireNew(const FoundScans& found, const fabrics::ImportStage& stage, const fabrics::Dataset& dataset)
{
    if (!stage.isNew() && !dataset.surfaceIsFree && hasSurfaces(dataset))
        throw protocols::badInput({"has surfaces of pressed cloth", dataset.folder.string(),
                                   "one kind of surface for each data set", "import the scans into another data set"});
    for (const ScanFiles& scan : found.fabrics)
        for (const fabrics::FabricInfo& fabric : dataset.fabrics)
            if (fabric.name == scan.name)
                throw protocols::badInput({"\"" + scan.name + "\" is in the data set already, as " + fabric.id.value,
                                           dataset.folder.string(), "fabrics that it does not have",
                                           "import into another data set, or move the scan away"});
}

/// Throws badInput where fewer than three bands fit, and names the side that would.
void requireRoom(const ScanFiles& files, cv::Size tile, int sidePx)
{
    const int largest = patchSideFor(tile, sidePx);
    if (largest >= sidePx) return;
    const bool isPossible = largest >= leastPatchPx;
    throw protocols::badInput(
        {"\"" + files.name + "\" is " + std::to_string(tile.width) + " x " + std::to_string(tile.height) +
             " px, which has no room for three bands of patches of " + std::to_string(sidePx) + " px with guards of " +
             std::to_string(guardPx) + " px",
         files.folder.string(), isPossible ? "patches of at most " + std::to_string(largest) + " px" : "at least 240 px a side",
         isPossible ? "give --patch " + std::to_string(largest) : "download a larger size, or move this scan away"});
}

}  // namespace

std::vector<std::string> importScans(const ScanImport& request)
{
    const FoundScans found = scansIn(request.folder);
    const auto widths = tileWidths(found.fabrics, request.folder, request.tiles);
    fabrics::ImportStage stage(request.out);
    requireNew(found, stage, stage.dataset());
    const int total = static_cast<int>(found.fabrics.size());
    std::vector<std::string> lines;
    for (int i = 0; i < total; ++i) {
        if (request.progress) request.progress(i, total);
        const auto at = static_cast<std::size_t>(i);
        const Scan scan = readScan(found.fabrics[at], widths[at].mm, request.decodeOther);
        requireRoom(found.fabrics[at], scan.surface.size(), request.patchPx);
        const auto said = writeFabric(stage, found.fabrics[at], scan, widths[at], request.patchPx);
        lines.insert(lines.end(), said.begin(), said.end());
    }
    if (request.progress) request.progress(total, total);
    for (const auto& said : {leftOutLines(found.leftOver, "(no colour, normals or displacement by name)"),
                             leftOutLines(found.unread, "(a format that is not read; convert to PNG what is needed)")})
        lines.insert(lines.end(), said.begin(), said.end());
    stage.dataset().surfaceIsFree = true;
    stage.commit();
    return lines;
}

}  // namespace rendering::scans
