// vis2hap stroke IMAGE --csv FILE
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/display/stroke.h"
#include "rendering/images/image_io.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/looking/open_study.h"

namespace study::commands {

namespace {

struct StrokeCall {
    std::string image, csv;
    std::optional<int> row;
    bool vertical = false;
    rendering::StrokeOptions options;
};

cv::Mat readFrictionImage(const std::string& file)
{
    const cv::Mat image = rendering::readImage(file);
    if (image.type() == CV_8UC1 || image.type() == CV_16UC1) return image;
    throw protocols::badInput(
        {"is not a friction image", file, "one grey channel of 8 or 16 bits", "make one with `vis2hap render`"});
}

int lineOf(const StrokeCall& call, const cv::Mat& image)
{
    const int lines = call.vertical ? image.cols : image.rows;
    const int line = call.row.value_or(lines / 2);
    if (line >= 0 && line < lines) return line;
    throw protocols::badInput({"there is no line " + std::to_string(line) + " to stroke along", call.image,
                               "0 to " + std::to_string(lines - 1), "leave --line out to stroke along the middle"});
}

int stroke(const StrokeCall& call)
{
    looking::requireNotOfOpenStudy(call.image);
    const cv::Mat image = readFrictionImage(call.image);
    const auto samples = rendering::strokeImage(image, lineOf(call, image), call.vertical, call.options);
    protocols::writeWholeFile(call.csv, rendering::strokeCsv(samples));
    double sum = 0;
    for (const auto& sample : samples) sum += sample.tangentialN / sample.normalN;
    std::printf("%s: %zu samples over %.2f mm in %.3f s, mean coefficient of friction %.3f\n",
                protocols::printable(call.csv).c_str(), samples.size(), samples.back().positionMm, samples.back().timeS,
                sum / static_cast<double>(samples.size()));
    return 0;
}

}  // namespace

void addStroke(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("stroke", "compute the friction force on a simulated finger over time");
    command->footer(
        "The model: the finger pad averages the image over its contact (a Gaussian with sigma = contact / 2). Friction rises\n"
        "linearly with the pixel value, from 0.3 (plain glass) at 0 to 0.9 at full scale. The tangential force is friction\n"
        "times normal force, with a first-order response (2 ms). The stroke runs from left to right (--vertical: from top\n"
        "to bottom) at constant speed. Columns: t_s, position_mm, normal_n, tangential_n. Simulated participants feel\n"
        "images in this way.");
    auto call = std::make_shared<StrokeCall>();
    auto& options = call->options;
    command->add_option("IMAGE", call->image, "friction image: PNG or PGM, grey")->required();
    command->add_option("--csv", call->csv, "file to write")->required();
    command->add_option("--speed", options.speedMmPerS, "speed of the finger, mm/s")->capture_default_str();
    command->add_option("--line", call->row, "row (--vertical: column) to stroke along, from 0 (default: the middle one)");
    command->add_flag("--vertical", call->vertical, "stroke from top to bottom");
    command->add_option("--mm-per-pixel", options.mmPerPixel, "pitch of the display, mm")->capture_default_str();
    command->add_option("--normal-force", options.normalForceN, "normal force of the finger, N")->capture_default_str();
    command->add_option("--contact", options.contactMm, "diameter of the contact, mm")->capture_default_str();
    command->add_option("--response", options.responseS, "time constant of the response, s")->capture_default_str();
    command->add_option("--rate", options.sampleRateHz, "samples per second")->capture_default_str();
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return stroke(*call); };
    });
}

}  // namespace study::commands
