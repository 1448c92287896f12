// vis2hap import KIND FROM... --out DIR [--fabric ID]; friction records: [--normal COLUMN] [--tangential COLUMNS]
// [--force-unit UNIT] [--zero WHEN] [--trim WHEN] [--rate HZ] [--plots DIR]; scans: [--tile-mm W] [--tile NAME=W]... [--patch PX]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/import.h"
#include "rendering/fabrics/recordings/photograph_files.h"
#include "rendering/images/image_io.h"
#include "rendering/scans/import_scans.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/spectrogram_file.h"
#include "rendering/signals/tactile/calibration.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/number_checks.h"
#include "study/commands/parts/progress.h"
#include "study/looking/picture_decoder.h"

namespace study::commands {

namespace {

struct ImportCall {
    std::string kind;
    std::vector<std::string> from;
    std::string out;
    std::string fabric, fibre;
    std::string calibration, normal, tangential, forceUnit, zero = "auto", trim = "auto", plots;
    std::optional<double> rate, tileMm;
    std::vector<std::string> tiles;  ///< NAME=W
    std::optional<int> patchPx;
};

rendering::fabrics::FrictionOptions frictionOptions(const ImportCall& call)
{
    using namespace rendering::fabrics;
    FrictionOptions options;
    if (const auto axes = axesFrom(call.normal, "--normal", 1); !axes.empty()) options.normal = axes.front();
    options.tangential = axesFrom(call.tangential, "--tangential", 2);
    options.forceUnit = call.forceUnit;
    if (!call.forceUnit.empty() && !newtonsIn(call.forceUnit))
        throw protocols::badInput({"\"" + call.forceUnit + "\" is not a known unit of force", "--force-unit",
                                   std::string(knownForceUnits), "check the spelling"});
    options.zero = selectionFrom(call.zero, "--zero", options.zeroInterval);
    options.trim = selectionFrom(call.trim, "--trim", options.trimInterval);
    options.rateHz = call.rate;
    return options;
}

/// Writes the spectrogram of each imported stroke, with its parameters, beside its plot.
void writeSpectrograms(const std::filesystem::path& out, const std::filesystem::path& plots)
{
    using namespace rendering::fabrics;
    const auto dataset = readDataset(out);
    protocols::FolderDraft draft(plots, protocols::Earlier::FilesJoined);
    for (const auto& fabric : dataset.fabrics)
        for (const int index : sampleIndices(dataset, fabric.id, Modality::Friction)) {
            const auto sample = samplePath(dataset, fabric.id, Modality::Friction, index);
            const std::string name = fabric.id.value + "-" + sample.stem().string();
            if (!std::filesystem::exists(plots / (name + ".svg"))) continue;
            const auto record = readFriction(dataset, fabric.id, index);
            if (record.values.size() < static_cast<std::size_t>(rendering::signals::shortestTrace)) continue;
            if (record.isCoefficient() && !(record.mean() > 0)) continue;  // the import has warned of its axis
            const auto trace = rendering::signals::frictionTrace(record, sample.string());
            rendering::signals::SpectrogramParameters parameters;
            parameters.sampleRateHz = trace.sampleRateHz;
            rendering::writeSpectrogram(draft.file(name + ".spectrogram.json"),
                                        rendering::signals::stft(trace.values, parameters), protocols::Sync::Later);
        }
    draft.putInPlace();
}

/// A calibration, with the frame of the untouched sensor that `calibrate` saved beside it.
rendering::fabrics::ImportedSensor sensorFrom(const std::filesystem::path& file)
{
    namespace signals = rendering::signals;
    const auto calibration = signals::readCalibration(file);
    if (calibration.channels != 3)
        throw protocols::badInput({"the sensor takes " + std::to_string(calibration.channels) + " frames, one for each lamp",
                                   file.string(), "a sensor of colour frames",
                                   "compute heights from its frames with vis2hap height"});
    rendering::fabrics::ImportedSensor sensor{protocols::readWholeFile(file), calibration.mmPerPixel, {}, {}};
    sensor.requireSame = [look = calibration.sensor, file](const cv::Mat& reference, const std::string& where) {
        const auto difference = look ? signals::differenceOf(*look, signals::appearanceOf(reference)) : std::nullopt;
        if (difference)
            throw protocols::badInput({"the frame is not from the calibrated sensor: " + *difference, where,
                                       "a frame of the sensor of " + file.string(),
                                       "calibrate this sensor, or name its own background"});
    };
    const auto background = file.parent_path() / (file.stem().string() + "-background.png");
    // A calibration of 16-bit frames has such a background; frames are imported with 8 bits.
    if (std::filesystem::exists(background))
        sensor.untouched = rendering::fabrics::inEightBits(rendering::readPng(background), background);
    return sensor;
}

rendering::scans::TileOptions tilesFrom(const ImportCall& call)
{
    rendering::scans::TileOptions tiles{call.tileMm, {}};
    for (const std::string& text : call.tiles) {
        const auto equals = text.rfind('=');
        const auto width = equals == std::string::npos ? std::nullopt : protocols::numberIn(text.substr(equals + 1));
        if (!width || equals == 0)
            throw protocols::badInput({"\"" + text + "\" is no width of a tile", "--tile", "NAME=WIDTH, such as weave=268.1",
                                       "give the name of the fabric and the width of its whole image in mm"});
        tiles.ofFabric[text.substr(0, equals)] = *width;
    }
    return tiles;
}

int importScans(const ImportCall& call)
{
    if (call.from.size() != 1)
        throw protocols::badInput({std::to_string(call.from.size()) + " folders are named", "FROM", "one folder of scans",
                                   "import one folder after another into the same data set"});
    if (!call.fabric.empty() || !call.fibre.empty() || !call.calibration.empty() || !call.plots.empty())
        throw protocols::badInput({"--fabric, --fibre, --calibration and --plots do not apply to scans", "import scans",
                                   "--tile-mm, --tile and --patch", "leave them out"});
    rendering::scans::ScanImport request{call.from.front(), call.out, tilesFrom(call)};
    request.patchPx = call.patchPx.value_or(request.patchPx);
    request.decodeOther = looking::decodeByQt;
    Progress progress("importing");
    request.progress = [&](int done, int total) { progress.show(done, total, "fabrics"); };
    for (const auto& line : rendering::scans::importScans(request)) std::printf("%s\n", protocols::printable(line).c_str());
    return 0;
}

int import(const ImportCall& call)
{
    if (call.kind == "scans") return importScans(call);
    if (call.tileMm || !call.tiles.empty() || call.patchPx)
        throw protocols::badInput(
            {"--tile-mm, --tile and --patch apply to scans only", "import " + call.kind, "import scans", "leave them out"});
    rendering::fabrics::ImportRequest request;
    request.kind = rendering::fabrics::importKindNamed(call.kind);
    request.from.assign(call.from.begin(), call.from.end());
    request.out = call.out;
    if (!call.fabric.empty()) request.fabric = protocols::FabricId(call.fabric);
    if (!call.fibre.empty()) {
        request.fibre = rendering::fabrics::fibreFrom(call.fibre);
        if (!request.fibre)
            throw protocols::badInput({"\"" + call.fibre + "\" is no known fibre", "--fibre", rendering::fabrics::fibreNames(),
                                       "leave --fibre out for another fibre and for a mixture"});
    }
    request.decodeOther = looking::decodeByQt;
    request.friction = frictionOptions(call);
    if (!call.calibration.empty()) {
        if (request.kind != rendering::fabrics::ImportKind::Gelsight)
            throw protocols::badInput(
                {"only tactile frames have a calibration", "--calibration", "import gelsight", "leave --calibration out"});
        request.sensor = sensorFrom(call.calibration);
    }
    request.plots = call.plots;
    if (!call.plots.empty()) protocols::makeFolders(call.plots);  // before the import, which a fault here must not interrupt
    for (const auto& line : rendering::fabrics::importRecordings(request))
        std::printf("%s\n", protocols::printable(line).c_str());
    if (!call.plots.empty() && std::filesystem::exists(call.plots)) writeSpectrograms(call.out, call.plots);
    return 0;
}

}  // namespace

void addImport(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("import", "import recordings into a data set");
    auto call = std::make_shared<ImportCall>();
    command->add_option("KIND", call->kind, "photos, scans, gelsight, friction-csv, tribometer, labview or slide")->required();
    command->add_option("FROM", call->from, "files or folders to import")->required();
    command->add_option("--out", call->out, "the data set; recordings are added to an existing one")->required();
    command->add_option("--fabric", call->fabric, "import everything as recordings of this fabric, e.g. F03");
    command->add_option("--fibre", call->fibre,
                        "fibre of the imported fabrics, as their label says: " + rendering::fabrics::fibreNames());
    command->add_option("--calibration", call->calibration,
                        "calibration of the sensor that took the gelsight frames, from vis2hap calibrate");
    const char* scans = "Scanned materials";
    command->add_option("--tile-mm", call->tileMm, "width of the whole image of every scan in mm")->group(scans);
    command->add_option("--tile", call->tiles, "NAME=W: width of one fabric's image in mm; may be given several times")
        ->allow_extra_args(false)
        ->group(scans);
    command->add_option("--patch", call->patchPx, "side of the photographs cut from a scan, px (default: 256)")
        ->check(CLI::Range(rendering::scans::leastPatchPx, 2048))
        ->group(scans);
    const char* friction = "Friction records";
    command->add_option("--normal", call->normal, "column of the normal force; a minus reverses its sign: --normal=-fz")
        ->group(friction);
    command
        ->add_option("--tangential", call->tangential, "one column, which keeps its sign, or two: fx,fy gives sqrt(fx^2 + fy^2)")
        ->group(friction);
    command->add_option("--force-unit", call->forceUnit, "unit of columns whose names state none (default: N)")->group(friction);
    command->add_option("--zero", call->zero, "unloaded part, whose mean is subtracted: auto, none, or FROM,TO in s")
        ->group(friction)
        ->capture_default_str();
    command->add_option("--trim", call->trim, "steady slide, which is kept: auto, none, or FROM,TO in s")
        ->group(friction)
        ->capture_default_str();
    command->add_option("--rate", call->rate, "sample rate in Hz to resample to (default: the median of the record's own steps)")
        ->group(friction)
        ->check(finiteIn(rendering::fabrics::leastRateHz, rendering::fabrics::mostRateHz));
    command->add_option("--plots", call->plots, "folder to write a plot and a spectrogram of each stroke to")->group(friction);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;  // Qt finds its JPEG reader through the application object
        action.work = [call] { return import(*call); };
    });
}

}  // namespace study::commands
