#include "rendering/fabrics/recordings/import_friction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/friction_plot.h"
#include "rendering/fabrics/recordings/friction_report.h"
#include "rendering/fabrics/recordings/friction_tables.h"
#include "rendering/fabrics/recordings/import_sources.h"
#include "rendering/fabrics/recordings/instrument_texts.h"
#include "rendering/fabrics/recordings/labview_texts.h"

namespace rendering::fabrics {

using protocols::Sync;

namespace {

constexpr double mostLengthMm = 1e8;

struct Instrument {
    ImportKind kind;
    std::array<std::string_view, 2> endings;
    FabricNaming naming;
    std::vector<RawRecord> (*read)(const std::filesystem::path&, const FrictionOptions&);
};

constexpr Instrument instruments[] = {
    {ImportKind::FrictionCsv, {".csv", ".csv"}, FabricNaming::FolderOrFile, readFrictionCsv},
    {ImportKind::Tribometer, {".txt", ".mtm"}, FabricNaming::FolderOrFile, readTribometer},
    {ImportKind::Labview, {".txt", ".lvm"}, FabricNaming::FolderOrFile, readLabview},
    {ImportKind::Slide, {".csv", ".csv"}, FabricNaming::BeforeForce, readSlide},
};

const Instrument& instrumentOf(ImportKind kind)
{
    return *std::find_if(std::begin(instruments), std::end(instruments), [&](const Instrument& one) { return one.kind == kind; });
}

std::string describe(const RawRecord& record, const PreparedRecord& prepared)
{
    const bool coefficient = !record.normalN.empty() || record.quantity == "mu";
    std::string line = record.instrument + ", " + std::to_string(record.values.size()) + " rows, " + record.meaning + ", mean " +
                       fourFigures(prepared.mean) + (coefficient ? "" : " (not a coefficient)") + ", " +
                       fourFigures(1 / prepared.stepS) + " Hz";
    if (!record.form.empty()) line += ", read with " + record.form;
    if (prepared.resampling != "none")
        line += " (own steps " + fourFigures(prepared.base.smallestS * 1000) + " to " +
                fourFigures(prepared.base.largestS * 1000) + " ms; resampled, " + prepared.resampling + ", to " +
                std::to_string(prepared.values.size()) + " samples)";
    return line;
}

/// True where the data set already holds friction records, so that its friction section is fixed.
bool hasFriction(const Dataset& dataset)
{
    return std::any_of(dataset.fabrics.begin(), dataset.fabrics.end(),
                       [&](const FabricInfo& fabric) { return !sampleIndices(dataset, fabric.id, Modality::Friction).empty(); });
}

std::string remarkOnSpeed(const PreparedRecord& prepared, const Dataset& dataset)
{
    const std::string known = fourFigures(dataset.friction.speedMmPerS) + " mm/s";
    if (!prepared.speedMmPerS) return ", speed not stated (the data set's " + known + " is assumed)";
    const std::string own = fourFigures(*prepared.speedMmPerS) + " mm/s";
    if (std::abs(*prepared.speedMmPerS / dataset.friction.speedMmPerS - 1) < 0.01) return ", " + own;
    return ", " + own + " (the data set states " + known + "; this record keeps its own)";
}

std::string titleOf(const FabricInfo& fabric, int sample)
{
    return fabric.id.value + (fabric.name == fabric.id.value ? "" : " " + fabric.name) + ", sample " + std::to_string(sample);
}

}  // namespace

std::string frictionCsv(const PreparedRecord& prepared, const std::string& quantity)
{
    const bool forces = !prepared.evenNormalN.empty();
    std::string text = forces ? "t_s,normal_n,tangential_n\n" : protocols::csvRow({"t_s", quantity});
    for (std::size_t i = 0; i < prepared.values.size(); ++i) {
        std::vector<std::string> cells{protocols::shortest(std::round(double(i) * prepared.stepS * 1e9) / 1e9)};
        if (forces) cells.push_back(protocols::shortest(prepared.evenNormalN[i]));
        cells.push_back(protocols::shortest(prepared.values[i]));
        text += protocols::csvRow(cells);
    }
    return text;
}

FrictionRecording recordingOf(const RawRecord& record, const PreparedRecord& prepared, FrictionRecording known)
{
    known.sampleRateHz = std::round(1 / prepared.stepS * 1e6) / 1e6;
    if (!prepared.speedMmPerS) return known;
    known.speedMmPerS = *prepared.speedMmPerS;
    const double lengthMm = *prepared.speedMmPerS * prepared.stepS * double(prepared.values.size());
    known.lengthMm = std::round(lengthMm * 1e3) / 1e3;
    if (!(known.lengthMm > 0 && known.lengthMm <= mostLengthMm))
        throw protocols::badInput({"the stroke is " + fourFigures(lengthMm) + " mm long", record.where, "0.001 mm to 100 km",
                                   "check its speed and its time stamps"});
    return known;
}

std::vector<std::string> importFrictionFiles(const ImportRequest& request, ImportStage& stage)
{
    const Instrument& instrument = instrumentOf(request.kind);
    const auto files = sourceFiles(request.from, instrument.endings, instrument.naming);
    Dataset& dataset = stage.dataset();
    bool first = stage.isNew() || !hasFriction(dataset);
    std::vector<std::string> lines;
    for (const SourceFile& source : files)
        for (const RawRecord& record : instrument.read(source.file, request.friction)) {
            const PreparedRecord done = prepare(record, request.friction);
            const FrictionRecording recording = recordingOf(record, done, dataset.friction);
            if (first) dataset.friction = recording;
            first = false;
            const auto fabric = stage.fabricFor(source.fabricName, request.fabric);
            const auto slot = stage.addSample(fabric, Modality::Friction);
            protocols::writeWholeFile(slot.file, frictionCsv(done, record.quantity), Sync::Later);
            protocols::writeWholeFile(stage.beside(slot, ".json"), preparationJson(record, request.friction, done), Sync::Later);
            const std::string title = titleOf(dataset.fabric(fabric), slot.index);
            if (!request.plots.empty())
                stage.keepPlot({fabric.value + "-" + slot.file.stem().string() + ".svg", frictionPlot(title, record, done)});
            lines.push_back(title + ": " + describe(record, done) + remarkOnSpeed(done, dataset) + describeCuts(done));
        }
    return lines;
}

}  // namespace rendering::fabrics
