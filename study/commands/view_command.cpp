// vis2hap view FILE… --out PNG
#include <CLI/CLI.hpp>
#include <QBuffer>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/number_checks.h"
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
    writeFile(call.out, std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
    std::printf("%s\n", looking::describe(signals).toUtf8().constData());
    return 0;
}

}  // namespace

void addView(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("view", "signals as picture, relief and profile with units, side by side on one sheet");
    command->footer(
        "Photographs, tactile frames and friction images (PNG, PGM, JPEG), heights in mm (TIFF, TMD), gradients (.npy) and\n"
        "friction records (CSV: curve, spectrogram and spectrum). States least, largest and mean value, Sq (root mean\n"
        "square about the mean), and the shares of clipped and missing points. In a data set the scale is known;\n"
        "elsewhere say it. The stimuli of a study that is not unblinded are refused.");
    auto call = std::make_shared<ViewCall>();
    command->add_option("FILE", call->files, "what to look at")->required();
    command->add_option("--out", call->out, "PNG to write")->required();
    command->add_option("--mm-per-pixel", call->reading.mmPerPixel, "scale of pictures and maps")->check(finiteIn(1e-6, 1e3));
    command->add_option("--speed", call->reading.speedMmPerS, "of a stroke, mm/s, to draw it over mm")
        ->check(finiteIn(1e-6, 1e6));
    command->add_option("--unit", call->reading.unit, "of the values of TIFF and .npy (default: mm; .npy: mm/mm)");
    command->add_option("--per-row", call->perRow, "signals beside each other")->check(CLI::Range(1, 12))->capture_default_str();
    command->add_option("--quantity", call->reading.quantity, "column of a record to look at (default: its friction)");
    command->add_option("--width", call->columnPx, "pixels across for each")->check(CLI::Range(300, 2000))->capture_default_str();
    command->add_flag("--dark", call->isDark, "light on dark");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Offscreen;
        action.work = [call] { return view(*call); };
    });
}

}  // namespace study::commands
