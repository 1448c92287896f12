// vis2hap height FRAME... --calibration FILE | --gradients GX GY | --normals IMAGE, --out DIR
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/number_checks.h"
#include "study/looking/picture_decoder.h"
#include "study/measuring/height_reconstruction.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
using protocols::Sync;
namespace signals = rendering::signals;
using nlohmann::ordered_json;

const std::map<std::string, measuring::NormalsY> normalsY{
    {"auto", measuring::NormalsY::Auto}, {"up", measuring::NormalsY::Up}, {"down", measuring::NormalsY::Down}};

struct HeightCall {
    std::vector<std::string> frames, gradients;
    std::string calibration, background, normals, mask, out, kind = "point", contact = "auto", quality = "full",
                                                             normalsY = "auto";
    std::optional<signals::Pitch> pitch;
    double cutoffMm = 0;
};

/// "0.05" or "0.05,0.1". An empty part is refused; a list of CLI11 would skip it.
signals::Pitch pitchFrom(const std::string& text)
{
    std::vector<double> numbers;
    bool areGood = !text.ends_with(',');  // split() drops an empty last part
    for (std::string& part : CLI::detail::split(text, ',')) {
        areGood = areGood && aboveZero()(part).empty();
        CLI::detail::lexical_cast(part, numbers.emplace_back());
    }
    if (!areGood || numbers.empty() || numbers.size() > 2)
        throw CLI::ValidationError("--pitch", text + " is not one number above 0, or two with a comma between them");
    return {numbers.front(), numbers.back()};
}

measuring::HeightOptions heightOptionsOf(const HeightCall& call)
{
    measuring::HeightOptions options;
    if (call.cutoffMm > 0) options.cutoffMm = call.cutoffMm;
    options.quality = call.quality == "full" ? signals::IntegrationQuality::Full : signals::IntegrationQuality::Fast;
    return options;
}

measuring::SlopeSampling samplingOf(const HeightCall& call)
{
    measuring::SlopeSampling sampling;
    if (call.pitch) sampling.pitch = *call.pitch;
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
    protocols::FolderDraft draft(call.out, protocols::Earlier::FilesJoined);
    double low = 0, high = 0;
    cv::minMaxLoc(result.heightMm, &low, &high);
    cv::Scalar mean, sd;
    cv::meanStdDev(result.heightMm, mean, sd);
    rendering::writeTiff(draft.file(result.name + ".tiff"), result.heightMm, Sync::Later);
    rendering::writeNpy(draft.file(result.name + "-gx.npy"), result.slopes.x, Sync::Later);
    rendering::writeNpy(draft.file(result.name + "-gy.npy"), result.slopes.y, Sync::Later);
    ordered_json facts{{"schema", "vis2hap.height/1"}, {"range_mm", {low, high}}, {"sq_mm", sd[0]}};
    facts.update(result.facts);
    protocols::writeWholeFile(draft.file(result.name + ".json"), facts.dump(2) + "\n", Sync::Later);
    draft.putInPlace();
    std::printf("%s.tiff  %d x %d, 0 to %.4g mm, Sq %.4g mm%s\n",
                protocols::printable((fs::path(call.out) / result.name).string()).c_str(), result.heightMm.cols,
                result.heightMm.rows, high, sd[0],
                facts.contains("curl_residual")
                    ? (", curl " + protocols::shortest(std::round(1e4 * facts["curl_residual"].get<double>()) / 1e4)).c_str()
                    : "");
}

int height(const HeightCall& call)
{
    const int sources = !call.frames.empty() + !call.gradients.empty() + !call.normals.empty();
    if (sources != 1 || (!call.frames.empty() && call.calibration.empty()))
        throw protocols::badInput(
            {sources == 1 ? "frames need a calibration" : std::to_string(sources) + " sources of heights are named", "",
             "frames with --calibration, or --gradients, or --normals", "name one of these"});
    if (!call.frames.empty() && (!call.mask.empty() || call.pitch || call.kind != "point"))
        throw protocols::badInput({"--mask, --pitch and --kind apply to --gradients and --normals only, not to frames",
                                   call.frames.front(), "frames and --calibration",
                                   "leave them out; --contact takes a mask of the contact"});
    if (call.frames.empty() && (call.contact != "auto" || !call.calibration.empty()))
        throw protocols::badInput({"--contact and --calibration apply to frames only", "", "frames", "leave them out"});
    if (call.contact != "auto" && call.contact != "whole" && call.contact != "part" && !fs::exists(call.contact))
        throw protocols::badInput({"\"" + call.contact + "\" is neither a kind of contact nor an image", "--contact",
                                   "auto, whole, part, or a mask image", "check the spelling or the path"});
    const auto options = heightOptionsOf(call);
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
    auto* command = app.add_subcommand("height", "compute heights in mm from tactile frames, gradients or a normal map");
    auto call = std::make_shared<HeightCall>();
    command->add_option("FRAME", call->frames, "colour frames, or grey ones in the order of the sensor's lamps");
    command->add_option("--calibration", call->calibration, "calibration file from vis2hap calibrate");
    command->add_option("--background", call->background,
                        "frame of the untouched sensor (default: the one saved with the calibration)");
    command->add_option("--contact", call->contact,
                        "where the object touches the sensor: auto, whole (the whole frame), part, or a mask image");
    command->add_option("--gradients", call->gradients, "dh/dx and dh/dy in mm/mm (.npy or .tiff)")->expected(2);
    command->add_option("--kind", call->kind, "what the gradients are: point slopes, central or forward differences")
        ->check(CLI::IsMember({"point", "central", "forward"}));
    command->add_option("--normals", call->normals, "normal map, (n + 1) / 2 as RGB");
    command
        ->add_option("--normals-y", call->normalsY,
                     "direction of y in the normal map: up, down, or auto (the one whose slopes fit a surface)")
        ->check(CLI::IsMember({"auto", "up", "down"}));
    command->add_option_function<std::string>(
        "--pitch", [call](const std::string& text) { call->pitch = pitchFrom(text); },
        "mm between pixels along x,y (one number: both directions; default 1)");
    command->add_option("--mask", call->mask,
                        "image, 0 where gradients or normals were not measured; these places, and NaN, are filled smoothly");
    command->add_option("--cutoff", call->cutoffMm, "mm; removes waves longer than this")->check(aboveZero());
    command->add_option("--quality", call->quality, "full (double precision) or fast (single precision)")
        ->check(CLI::IsMember({"full", "fast"}));
    command->add_option("--out", call->out, "folder to write NAME.tiff, NAME-gx.npy, NAME-gy.npy and NAME.json to")->required();
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return height(*call); };
    });
}

}  // namespace study::commands
