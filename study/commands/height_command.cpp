// vis2hap height FRAME... --calibration FILE | --gradients GX GY | --normals IMAGE, --out DIR
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/images/image_io.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/number_checks.h"
#include "study/looking/picture_decoder.h"
#include "study/measuring/height_reconstruction.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
namespace signals = rendering::signals;
using nlohmann::ordered_json;

const std::map<std::string, measuring::NormalsY> normalsY{
    {"auto", measuring::NormalsY::Auto}, {"up", measuring::NormalsY::Up}, {"down", measuring::NormalsY::Down}};

struct HeightCall {
    std::vector<std::string> frames, gradients;
    std::string calibration, background, normals, mask, out, kind = "point", contact = "auto", quality = "full",
                                                             normalsY = "auto";
    std::vector<double> pitch;
    double cutoffMm = 0;
};

measuring::HeightOptions optionsOf(const HeightCall& call)
{
    measuring::HeightOptions options;
    if (call.cutoffMm > 0) options.cutoffMm = call.cutoffMm;
    options.quality = call.quality == "full" ? signals::IntegrationQuality::Full : signals::IntegrationQuality::Fast;
    return options;
}

measuring::SlopeSampling samplingOf(const HeightCall& call)
{
    measuring::SlopeSampling sampling;
    if (!call.pitch.empty()) sampling.pitch = {call.pitch.front(), call.pitch.back()};
    sampling.kind = signals::slopeKindNamed(call.kind);
    sampling.mask = call.mask;
    return sampling;
}

measuring::ContactChoice contactOf(const std::string& text)
{
    using Where = measuring::ContactChoice::Where;
    const std::map<std::string, Where> words{{"auto", Where::Auto}, {"whole", Where::Whole}, {"part", Where::Part}};
    if (const auto found = words.find(text); found != words.end()) return {found->second, {}};
    return {Where::Mask, text};
}

measuring::FramesRequest framesOf(const HeightCall& call)
{
    return {{call.frames.begin(), call.frames.end()}, call.calibration, call.background, contactOf(call.contact)};
}

void write(const HeightCall& call, const measuring::Reconstruction& result)
{
    const fs::path out(call.out);
    std::error_code failed;
    fs::create_directories(out, failed);
    if (failed)
        throw protocols::environmentFault(
            {"the folder cannot be made (" + failed.message() + ")", call.out, "a place that can be written to", ""});
    double low = 0, high = 0;
    cv::minMaxLoc(result.heightMm, &low, &high);
    cv::Scalar mean, sd;
    cv::meanStdDev(result.heightMm, mean, sd);
    rendering::writeTiff(out / (result.name + ".tiff"), result.heightMm);
    rendering::writeNpy(out / (result.name + "-gx.npy"), result.slopes.x);
    rendering::writeNpy(out / (result.name + "-gy.npy"), result.slopes.y);
    ordered_json facts{{"schema", "vis2hap.height/1"}, {"range_mm", {low, high}}, {"sq_mm", sd[0]}};
    facts.update(result.facts);
    writeFile(out / (result.name + ".json"), facts.dump(2) + "\n");
    std::printf("%s.tiff  %d x %d, 0 to %.4g mm, Sq %.4g mm%s\n", (out / result.name).c_str(), result.heightMm.cols,
                result.heightMm.rows, high, sd[0],
                facts.contains("curl_residual")
                    ? (", curl " + numberText(std::round(1e4 * facts["curl_residual"].get<double>()) / 1e4)).c_str()
                    : "");
}

int height(const HeightCall& call)
{
    const int sources = !call.frames.empty() + !call.gradients.empty() + !call.normals.empty();
    if (sources != 1 || (!call.frames.empty() && call.calibration.empty()))
        throw protocols::badInput({sources == 1 ? "frames need a calibration" : "one source of heights is needed", "",
                                   "frames with --calibration, or --gradients, or --normals", ""});
    if (!call.frames.empty() && (!call.mask.empty() || !call.pitch.empty() || call.kind != "point"))
        throw protocols::badInput({"--mask, --pitch and --kind are of gradients and normal maps", call.frames.front(),
                                   "a calibration knows its pitch; --contact takes a mask", ""});
    if (call.frames.empty() && (call.contact != "auto" || !call.calibration.empty()))
        throw protocols::badInput({"--contact and --calibration are of frames", "", "frames", ""});
    if (call.contact != "auto" && call.contact != "whole" && call.contact != "part" && !fs::exists(call.contact))
        throw protocols::badInput(
            {"\"" + call.contact + "\" is no kind of contact", "--contact", "auto, whole, part, or a mask image", ""});
    const auto options = optionsOf(call);
    if (!call.gradients.empty())
        write(call, measuring::fromGradients(call.gradients[0], call.gradients[1], samplingOf(call), options));
    else if (!call.normals.empty())
        write(call,
              measuring::fromNormals(call.normals, normalsY.at(call.normalsY), samplingOf(call), options, looking::decodeByQt));
    else
        for (const auto& result : measuring::fromFrames(framesOf(call), options, looking::decodeByQt)) write(call, result);
    return 0;
}

}  // namespace

void addHeight(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("height", "tactile frames, gradients or a normal map -> height in mm");
    auto call = std::make_shared<HeightCall>();
    command->add_option("FRAME", call->frames, "colour frames, or grey ones in the order of the sensor's lamps");
    command->add_option("--calibration", call->calibration, "made by vis2hap calibrate");
    command->add_option("--background", call->background, "the untouched sensor (default: the one saved with the calibration)");
    command->add_option("--contact", call->contact,
                        "auto, whole (fabric over the whole frame), part, or a mask image: where the object touches");
    command->add_option("--gradients", call->gradients, "dh/dx and dh/dy in mm/mm (.npy or .tiff)")->expected(2);
    command->add_option("--kind", call->kind, "of gradients: point slopes, central or forward differences")
        ->check(CLI::IsMember({"point", "central", "forward"}));
    command->add_option("--normals", call->normals, "a normal map, (n + 1) / 2 as RGB");
    command->add_option("--normals-y", call->normalsY, "up, down, or auto: whichever is a surface")
        ->check(CLI::IsMember({"auto", "up", "down"}));
    command->add_option("--pitch", call->pitch, "mm between pixels along x,y (one number: both; default 1)")
        ->delimiter(',')
        ->expected(1, 2)
        ->check(aboveZero());
    command->add_option("--mask", call->mask,
                        "0 where gradients or normals were not measured; these places, and NaN, are bridged");
    command->add_option("--cutoff", call->cutoffMm, "mm; waves longer than this are taken out")->check(aboveZero());
    command->add_option("--quality", call->quality, "full (double precision) or fast (single)")
        ->check(CLI::IsMember({"full", "fast"}));
    command->add_option("--out", call->out, "folder for NAME.tiff, NAME-gx.npy, NAME-gy.npy and NAME.json")->required();
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return height(*call); };
    });
}

}  // namespace study::commands
