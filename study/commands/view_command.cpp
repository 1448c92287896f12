// vis2hap view FILE… --out PNG
#include <CLI/CLI.hpp>
#include <QBuffer>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/number_checks.h"
#include "study/looking/picture_decoder.h"
#include "study/looking/read_signal.h"
#include "study/looking/sheet.h"

namespace study::commands {

namespace {

struct ViewCall {
    std::vector<std::string> files;
    std::string out;
    looking::ReadingOptions reading;
    int perRow = looking::signalsInARow;
    int columnPx = 460;
    bool isDark = false;
};

int view(const ViewCall& call)
{
    looking::ReadingOptions reading = call.reading;
    reading.decode = looking::decodeByQt;
    std::vector<looking::SeenSignal> signals;
    for (const std::string& file : call.files) signals.push_back(looking::readSignal(file, reading));
    looking::SheetStyle style = call.isDark ? looking::darkSheet() : looking::lightSheet();
    style.columnPx = call.columnPx;
    style.fontPx = call.columnPx / 460.0 * style.fontPx;
    QByteArray bytes;
    QBuffer buffer(&bytes);
    looking::drawSheet(signals, style, call.perRow).save(&buffer, "PNG");
    protocols::writeWholeFile(call.out, std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
    std::printf("%s\n", protocols::printableLines(looking::describe(signals).toStdString()).c_str());
    return 0;
}

}  // namespace

void addView(CLI::App& app, Action& action)
{
    auto* command =
        app.add_subcommand("view", "draw signals as picture, relief and profile with units, side by side on one sheet");
    command->footer(
        "Shows photographs, tactile frames and friction images (PNG, PGM, JPEG), heights in mm (TIFF, TMD), gradients (.npy)\n"
        "and friction records (CSV: curve, spectrogram and spectrum). States minimum, maximum and mean, Sq (root mean square\n"
        "about the mean), and the shares of clipped and missing points. A data set states its scale; for other files use\n"
        "--mm-per-pixel. Stimuli of a study that is not unblinded are refused.");
    auto call = std::make_shared<ViewCall>();
    command->add_option("FILE", call->files, "files to show")->required();
    command->add_option("--out", call->out, "PNG to write")->required();
    command->add_option("--mm-per-pixel", call->reading.mmPerPixel, "scale of pictures and maps")->check(finiteIn(1e-6, 1e3));
    command->add_option("--speed", call->reading.speedMmPerS, "speed of a stroke in mm/s, to draw it over mm")
        ->check(finiteIn(1e-6, 1e6));
    command->add_option("--unit", call->reading.unit, "unit of values in TIFF and .npy (default: mm; .npy: mm/mm)");
    command->add_option("--per-row", call->perRow, "signals in one row")->check(CLI::Range(1, 12))->capture_default_str();
    command->add_option("--quantity", call->reading.quantity, "column of a record to show (default: its friction)");
    command->add_option("--width", call->columnPx, "width of each signal in pixels")
        ->check(CLI::Range(300, 2000))
        ->capture_default_str();
    command->add_flag("--dark", call->isDark, "draw light on dark");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Offscreen;
        action.work = [call] { return view(*call); };
    });
}

}  // namespace study::commands
