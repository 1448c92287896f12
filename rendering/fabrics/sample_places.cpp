#include "rendering/fabrics/sample_places.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;

namespace {

constexpr const char* header = "fabric,signal,index,x_mm,y_mm,rotation_deg,group";

/// Columns that only some data sets have.
enum class Extra { MmPerPixel, Light, LightDeg };
constexpr struct {
    Extra extra;
    const char* name;
} extraColumns[] = {{Extra::MmPerPixel, "mm_per_pixel"}, {Extra::Light, "light"}, {Extra::LightDeg, "light_deg"}};

std::string cellOf(const std::optional<double>& value) { return value ? protocols::shortest(*value) : ""; }

std::string cellOf(const SamplePlace& place, Extra extra)
{
    switch (extra) {
        case Extra::MmPerPixel:
            return cellOf(place.mmPerPixel);
        case Extra::Light:
            return place.light;
        case Extra::LightDeg:
            return cellOf(place.lightDeg);
    }
    return {};
}

void readExtra(const protocols::CsvTable& table, std::size_t row, SamplePlace& place)
{
    for (const auto& [extra, name] : extraColumns) {
        const auto column = table.column(name);
        if (!column || protocols::isMissing(table.rows[row][*column])) continue;
        if (extra == Extra::Light) {
            place.light = table.rows[row][*column];
            continue;
        }
        const double value = protocols::numberAt(table, row, *column);
        if (extra == Extra::MmPerPixel && !(value > 0 && value < 1e9))
            throw protocols::badInput({"\"" + table.rows[row][*column] + "\" is no scale",
                                       protocols::rowName(table, row) + ", column mm_per_pixel", "a number above 0",
                                       "correct the cell"});
        (extra == Extra::MmPerPixel ? place.mmPerPixel : place.lightDeg) = value;
    }
}

Modality modalityAt(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    for (const Modality modality : allModalities)
        if (table.rows[row][column] == nameOf(modality)) return modality;
    throw protocols::badInput({"\"" + table.rows[row][column] + "\" is not a signal",
                               protocols::rowName(table, row) + ", column signal", "visual, tactile or friction",
                               "correct the cell"});
}

int indexAt(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    const double value = protocols::numberAt(table, row, column);
    if (value < 0 || value > 1e6 || value != std::floor(value))
        throw protocols::badInput({"\"" + table.rows[row][column] + "\" is not a sample number",
                                   protocols::rowName(table, row) + ", column index", "a whole number from 0",
                                   "correct the cell"});
    return int(value);
}

/// Part of each group over all signals, so that no split divides a group.
using PartOfGroup = std::map<std::string, Part>;

/// Assigns the groups of one fabric and signal 8:1:1. Groups that another signal has already assigned count towards it.
void shareOut(std::vector<std::string> groups, PartOfGroup& parts, protocols::Random random)
{
    const std::size_t tenth = groups.size() < 3 ? 0 : std::max<std::size_t>(1, (groups.size() + 5) / 10);
    std::map<Part, std::size_t> wanted{{Part::Validation, tenth}, {Part::Testing, tenth}};
    std::vector<std::string> open;
    for (const std::string& group : groups) {
        const auto placed = parts.find(group);
        if (placed == parts.end())
            open.push_back(group);
        else if (placed->second != Part::Training && wanted[placed->second] > 0)
            --wanted[placed->second];
    }
    random.shuffle(open);
    for (const std::string& group : open) {
        Part part = Part::Training;
        for (const Part small : {Part::Testing, Part::Validation})
            if (part == Part::Training && wanted[small] > 0) {
                part = small;
                --wanted[small];
            }
        parts[group] = part;
    }
}

}  // namespace

std::string ownGroup(const protocols::FabricId& fabric, Modality modality, int index)
{
    return fabric.value + "/" + nameOf(modality) + "/" + std::to_string(index);
}

std::vector<SamplePlace> readSamplePlaces(const Dataset& dataset)
{
    const fs::path file = dataset.folder / "samples.csv";
    if (!fs::exists(file)) return {};
    const protocols::CsvTable table = protocols::readForeignTable(file).table;
    const auto column = [&](const char* name) {
        if (const auto found = table.column(name)) return *found;
        throw protocols::badInput({std::string("has no column ") + name, table.where, header, "add the column"});
    };
    const std::size_t fabric = column("fabric"), signal = column("signal"), index = column("index"), x = column("x_mm"),
                      y = column("y_mm"), rotation = column("rotation_deg"), group = column("group");
    std::vector<SamplePlace> places;
    std::map<std::tuple<protocols::FabricId, Modality, int>, std::size_t> listed;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const auto optional = [&](std::size_t at) { return protocols::numberOrMissing(table, row, at); };
        SamplePlace place{protocols::FabricId(table.rows[row][fabric]),
                          modalityAt(table, row, signal),
                          indexAt(table, row, index),
                          optional(x),
                          optional(y),
                          optional(rotation),
                          protocols::isMissing(table.rows[row][group]) ? std::string() : table.rows[row][group]};
        readExtra(table, row, place);
        const auto [first, isNew] = listed.emplace(std::tuple(place.fabric, place.modality, place.index), row);
        if (!isNew)
            throw protocols::badInput({ownGroup(place.fabric, place.modality, place.index) + " is listed twice",
                                       protocols::rowName(table, first->second) + " and " + protocols::rowName(table, row),
                                       "one row for each sample", "remove one of the two rows"});
        if (place.group.empty()) place.group = ownGroup(place.fabric, place.modality, place.index);
        places.push_back(std::move(place));
    }
    return places;
}

void writeSamplePlaces(const Dataset& dataset, const std::vector<SamplePlace>& places)
{
    std::string text = header;
    std::vector<Extra> extras;
    for (const auto& [extra, name] : extraColumns)
        if (std::any_of(places.begin(), places.end(),
                        [extra = extra](const SamplePlace& place) { return !cellOf(place, extra).empty(); })) {
            extras.push_back(extra);
            text += std::string(",") + name;
        }
    text += "\n";
    for (const SamplePlace& place : places) {
        std::vector<std::string> cells{place.fabric.value, nameOf(place.modality), std::to_string(place.index),
                                       cellOf(place.xMm),  cellOf(place.yMm),      cellOf(place.rotationDeg),
                                       place.group};
        for (const Extra extra : extras) cells.push_back(cellOf(place, extra));
        text += protocols::csvRow(cells);
    }
    protocols::writeWholeFile(dataset.folder / "samples.csv", text, protocols::Sync::Later);
}

std::optional<double> photographPitch(const Dataset& dataset, const SamplePlace& place)
{
    return place.mmPerPixel ? place.mmPerPixel : dataset.cameraMmPerPixel;
}

PhotographViews::PhotographViews(const Dataset& dataset) : m_camera(dataset.cameraMmPerPixel)
{
    for (const SamplePlace& place : readSamplePlaces(dataset)) {
        if (place.modality != Modality::Visual) continue;
        if (place.mmPerPixel) m_pitches[{place.fabric, place.index}] = *place.mmPerPixel;
        if (place.lightDeg) m_lights[{place.fabric, place.index}] = *place.lightDeg;
    }
}

std::optional<double> PhotographViews::mmPerPixel(const protocols::FabricId& fabric, int index) const
{
    const auto own = m_pitches.find({fabric, index});
    return own == m_pitches.end() ? m_camera : own->second;
}

std::optional<double> PhotographViews::lightDeg(const protocols::FabricId& fabric, int index) const
{
    const auto own = m_lights.find({fabric, index});
    return own == m_lights.end() ? std::nullopt : std::optional(own->second);
}

std::vector<std::pair<SamplePlace, Part>> splitBySample(const Dataset& dataset, std::uint64_t seed)
{
    std::map<std::tuple<protocols::FabricId, Modality, int>, SamplePlace> known;
    for (const SamplePlace& place : readSamplePlaces(dataset)) known[{place.fabric, place.modality, place.index}] = place;
    std::vector<std::pair<SamplePlace, Part>> split;
    PartOfGroup parts;
    for (const FabricInfo& fabric : dataset.fabrics)
        for (const Modality modality : allModalities) {
            std::vector<std::string> groups;
            std::set<std::string> seen;
            for (const int index : sampleIndices(dataset, fabric.id, modality)) {
                const auto found = known.find({fabric.id, modality, index});
                SamplePlace place =
                    found != known.end()
                        ? found->second
                        : SamplePlace{fabric.id, modality, index, {}, {}, {}, ownGroup(fabric.id, modality, index)};
                if (seen.insert(place.group).second) groups.push_back(place.group);
                split.emplace_back(std::move(place), Part::Training);
            }
            shareOut(std::move(groups), parts,
                     protocols::Random::stream(seed, "split/" + fabric.id.value + "/" + nameOf(modality)));
        }
    for (auto& [place, part] : split) part = parts.at(place.group);
    return split;
}

}  // namespace rendering::fabrics
