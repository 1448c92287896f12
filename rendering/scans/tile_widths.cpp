#include "rendering/scans/tile_widths.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/scans/stated_resolution.h"

namespace rendering::scans {

namespace fs = std::filesystem;

namespace {

constexpr double leastTileMm = 1, mostTileMm = 100000;
constexpr double leastBelievableMm = 50, mostBelievableMm = 1000;
constexpr double mmPerInch = 25.4;
/// Resolutions that programs write where nobody stated one.
constexpr double usualDefaults[] = {1,   28,  37.79, 72,  75,  90,  95.98, 96,  100, 120, 144,
                                    150, 180, 200,   240, 300, 350, 360,   400, 600, 1200};

double checked(double mm, const std::string& where)
{
    if (mm >= leastTileMm && mm <= mostTileMm) return mm;
    throw protocols::badInput({"a tile is said to be " + protocols::shortest(mm) + " mm wide", where, "1 to 100,000 mm",
                               "give the width of the whole image in mm"});
}

std::optional<double> widthInJson(const fs::path& file)
{
    if (!fs::is_regular_file(file)) return {};
    const protocols::JsonDocument document(protocols::readWholeFile(file, protocols::largestJson), file.string());
    const nlohmann::json& root = document.root();
    if (!root.is_object() || !root.contains("tile_mm") || !root.at("tile_mm").is_number())
        throw document.faultAt("", "states no tile_mm", "{\"tile_mm\": 268.1}", "add the width of the tile in mm");
    return checked(root.at("tile_mm").get<double>(), file.string());
}

using NamedWidths = std::map<std::string, double>;

/// Rows of tiles.csv; empty where there is no such file.
NamedWidths widthsInTable(const fs::path& file)
{
    if (!fs::is_regular_file(file)) return {};
    const auto table = protocols::readForeignTable(file).table;
    const auto name = table.column("name"), width = table.column("width_mm");
    if (!name || !width)
        throw protocols::badInput({"lacks a column", file.string(), "name,width_mm", "write the header name,width_mm"});
    NamedWidths widths;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        if (!widths
                 .emplace(table.rows[row][*name],
                          checked(protocols::numberAt(table, row, *width), protocols::rowName(table, row)))
                 .second)
            throw protocols::badInput({"\"" + table.rows[row][*name] + "\" stands here twice", protocols::rowName(table, row),
                                       "each fabric once", "remove a row"});
    return widths;
}

std::string listed(const std::vector<ScanFiles>& fabrics)
{
    std::string list;
    for (const ScanFiles& fabric : fabrics) list += (list.empty() ? "" : ", ") + fabric.name;
    return list;
}

void requireKnown(const NamedWidths& widths, const std::vector<ScanFiles>& fabrics, const std::string& where)
{
    for (const auto& [name, mm] : widths)
        if (std::none_of(fabrics.begin(), fabrics.end(),
                         [&, name = name](const ScanFiles& fabric) { return fabric.name == name; }))
            throw protocols::badInput(
                {"there is no fabric \"" + name + "\"", where, "one of " + listed(fabrics), "correct the name"});
}

bool isUsualDefault(double perInch)
{
    return std::any_of(std::begin(usualDefaults), std::end(usualDefaults),
                       [&](double usual) { return std::abs(perInch - usual) < 0.02 * usual; });
}

/// What the images of a fabric say about their scale: a believable width, or a sentence why there is none.
struct ImageScale {
    std::optional<TileWidth> width;
    std::string why;
};

ImageScale scaleInImages(const ScanFiles& fabric)
{
    for (const auto* list : {&fabric.colour, &fabric.normals})
        for (const MapFile& map : *list) {
            const auto stated = statedResolution(protocols::readWholeFile(map.file));
            if (!stated || isUsualDefault(stated->perInch) || stated->widthPx == 0) continue;
            const double mm = mmPerInch * stated->widthPx / stated->perInch;
            const std::string file = map.file.filename().string();
            if (stated->hasUnit && mm >= leastBelievableMm && mm <= mostBelievableMm)
                return {TileWidth{mm, "the resolution stated in " + file}, {}};
            return {{},
                    file + " states " + protocols::shortest(std::round(stated->perInch * 10) / 10) + " pixels per inch" +
                        (stated->hasUnit ? "" : " without a unit") + ", which gives " +
                        protocols::shortest(std::round(mm * 10) / 10) + " mm (" +
                        protocols::shortest(std::round(mm * 8192 / stated->widthPx * 10) / 10) +
                        " mm if the file was reduced from 8k) and is not used"};
        }
    return {};
}

protocols::Error noWidth(const ScanFiles& fabric, const std::string& why)
{
    return protocols::badInput(
        {"the width of the tile of \"" + fabric.name + "\" in mm is unknown" + (why.empty() ? "" : "; " + why),
         fabric.folder.string(), "the width that the whole image shows, as the library publishes it",
         "give --tile " + fabric.name + "=WIDTH, or --tile-mm WIDTH for all, or tiles.csv (name,width_mm) beside the scans"});
}

}  // namespace

std::vector<TileWidth> tileWidths(const std::vector<ScanFiles>& fabrics, const fs::path& folder, const TileOptions& options)
{
    requireKnown(options.ofFabric, fabrics, "--tile");
    const NamedWidths shared = widthsInTable(folder / "tiles.csv");
    requireKnown(shared, fabrics, (folder / "tiles.csv").string());
    std::vector<TileWidth> widths;
    for (const ScanFiles& fabric : fabrics) {
        const auto add = [&](double mm, const std::string& source) { widths.push_back({mm, source}); };
        if (const auto own = options.ofFabric.find(fabric.name); own != options.ofFabric.end()) {
            add(checked(own->second, "--tile"), "--tile");
            continue;
        }
        if (const auto mm = widthInJson(fabric.folder / "scan.json")) {
            add(*mm, "scan.json");
            continue;
        }
        const NamedWidths beside = widthsInTable(fabric.folder / "tiles.csv");
        const auto inFolder = beside.find(fabric.name), inShared = shared.find(fabric.name);
        if (inFolder != beside.end() || inShared != shared.end()) {
            add(inFolder != beside.end() ? inFolder->second : inShared->second, "tiles.csv");
            continue;
        }
        if (options.allMm) {
            add(checked(*options.allMm, "--tile-mm"), "--tile-mm");
            continue;
        }
        const ImageScale images = scaleInImages(fabric);
        if (!images.width) throw noWidth(fabric, images.why);
        widths.push_back(*images.width);
    }
    return widths;
}

}  // namespace rendering::scans
