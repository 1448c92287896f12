// vis2hap height FRAME... --calibration FILE | --gradients GX GY | --normals IMAGE, --out DIR
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "rendering/images/image_io.h"
#include "rendering/signals/photometric_stereo.h"
#include "rendering/signals/press_folder.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/number_checks.h"
#include "study/looking/picture_decoder.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
namespace signals = rendering::signals;
using nlohmann::ordered_json;

struct HeightCall {
    std::vector<std::string> frames, gradients;
    std::string calibration, background, normals, mask, out, kind = "point", contact = "auto", quality = "full",
                                                             normalsY = "auto";
    std::vector<double> pitch;
    double cutoffMm = 0;
};

/// What one measurement gives: slopes, height above its zero, and what was done, for the file beside it.
struct Reconstruction {
    std::string name;
    signals::Slopes slopes;
    cv::Mat heightMm;
    ordered_json facts;
};

signals::IntegrationQuality qualityOf(const HeightCall& call)
{
    return call.quality == "full" ? signals::IntegrationQuality::Full : signals::IntegrationQuality::Fast;
}

signals::Pitch pitchOf(const HeightCall& call)
{
    if (call.pitch.empty()) return {};
    return {call.pitch.front(), call.pitch.back()};
}

cv::Mat maskOf(const std::string& file, cv::Size size)
{
    const cv::Mat mask = rendering::readImage(file);
    if (mask.size() != size || mask.channels() != 1)
        throw protocols::badInput(
            {"the mask has " + std::to_string(mask.cols) + " x " + std::to_string(mask.rows) + " pixels and " +
                 std::to_string(mask.channels()) + " channels",
             file, std::to_string(size.width) + " x " + std::to_string(size.height) + ", grey; 0: not measured", ""});
    return mask != 0;
}

double shareOf(const cv::Mat& places)
{
    return static_cast<double>(cv::countNonZero(places)) / static_cast<double>(places.total());
}

/// Slopes as they were given: the lowest place becomes 0, nothing else is changed.
void integrateAll(Reconstruction& result, const HeightCall& call, signals::SlopeKind kind)
{
    const auto pitch = pitchOf(call);
    cv::Mat measured = signals::measuredPlaces(result.slopes);
    if (!call.mask.empty()) measured &= maskOf(call.mask, measured.size());
    const bool whole = cv::countNonZero(measured) == static_cast<int>(measured.total());
    const cv::Mat integral = whole ? signals::integrate(result.slopes, pitch, kind, qualityOf(call))
                                   : signals::integrateAround(result.slopes, measured, pitch, kind);
    cv::Mat height = integral;
    if (call.cutoffMm > 0) height = signals::withoutLowFrequency(height, pitch, call.cutoffMm);
    double low = 0;
    cv::minMaxLoc(height, &low);
    height.convertTo(result.heightMm, CV_32F, 1, -low);
    if (!cv::checkRange(result.heightMm))
        throw protocols::badInput(
            {"the slopes give heights that no 32-bit number holds", result.name, "slopes in mm/mm", "check their units"});
    result.facts["pitch_mm"] = {pitch.x, pitch.y};
    result.facts["missing_share"] = 1 - shareOf(measured);
    result.facts["curl_residual"] = signals::curlResidual(result.slopes, integral, pitch, kind);
    result.facts["high_pass_cutoff_mm"] = nullptr;
    if (call.cutoffMm > 0) result.facts["high_pass_cutoff_mm"] = call.cutoffMm;
    result.facts["zero"] = "lowest place";
}

Reconstruction fromGradients(const HeightCall& call)
{
    Reconstruction result{"height", {rendering::readImage(call.gradients[0]), rendering::readImage(call.gradients[1])}, {}, {}};
    for (cv::Mat* slope : {&result.slopes.x, &result.slopes.y})
        if (slope->depth() != CV_32F && slope->depth() != CV_64F) slope->convertTo(*slope, CV_64F);
    if (result.slopes.x.size() != result.slopes.y.size())
        throw protocols::badInput(
            {"the slopes along x and y differ in size", call.gradients[1],
             std::to_string(result.slopes.x.cols) + " x " + std::to_string(result.slopes.x.rows) + " numbers", ""});
    result.facts = {{"from", "gradients"}, {"kind", call.kind}};
    integrateAll(result, call, signals::slopeKindNamed(call.kind));
    return result;
}

/// Which way a normal map's y points is often not said: the wrong way is no surface, and the share that cannot be integrated
/// tells. A part of the map is enough to see it.
bool yPointsDown(const signals::Slopes& slopes, const signals::Pitch& pitch, const std::string& said, ordered_json& facts)
{
    if (said != "auto") return said == "down";
    const cv::Rect part(cv::Point(), cv::Size(std::min(1024, slopes.x.cols), std::min(1024, slopes.x.rows)));
    const signals::Slopes up{slopes.x(part).clone(), slopes.y(part).clone()};
    const signals::Slopes down{up.x, -up.y};
    if (cv::countNonZero(signals::measuredPlaces(up)) == 0) return false;
    const auto residual = [&](const signals::Slopes& some) {
        return signals::curlResidual(some, signals::integrateAround(some, {}, pitch), pitch);
    };
    facts["curl_residual_y_up"] = residual(up);
    facts["curl_residual_y_down"] = residual(down);
    return facts["curl_residual_y_down"] < facts["curl_residual_y_up"];
}

Reconstruction fromNormals(const HeightCall& call)
{
    const auto pitch = pitchOf(call);
    Reconstruction result{fs::path(call.normals).stem().string(),
                          signals::slopesFromNormals(rendering::readPicture(call.normals, decodeByQt)),
                          {},
                          {}};
    result.facts = {{"from", "normals"}, {"kind", "point"}};
    const bool down = yPointsDown(result.slopes, pitch, call.normalsY, result.facts);
    if (down) result.slopes.y = -result.slopes.y;
    result.facts["normals_y"] = down ? "down" : "up";
    integrateAll(result, call, signals::SlopeKind::Point);
    return result;
}

cv::Mat referenceOf(const HeightCall& call, const signals::Calibration& calibration)
{
    if (calibration.light == signals::LightMeasure::AgainstOwnLight) return {};
    fs::path file = call.background;
    if (file.empty())
        file = fs::path(call.calibration).parent_path() / (fs::path(call.calibration).stem().string() + "-background.png");
    if (!fs::exists(file))
        throw protocols::badInput({"there is no frame of the untouched sensor", file.string(), "--background PNG",
                                   "name the frame taken before the presses"});
    const cv::Mat reference = rendering::readPicture(file, decodeByQt);
    if (calibration.sensor)
        if (const auto difference = signals::differenceOf(*calibration.sensor, signals::appearanceOf(reference)))
            throw protocols::badInput({"this background is not of the calibrated sensor: " + *difference, file.string(),
                                       "a frame of the sensor of " + call.calibration,
                                       "calibrate this sensor, or take its own background"});
    return reference;
}

cv::Mat contactPlaces(const HeightCall& call, const signals::Slopes& slopes, const signals::Pitch& pitch, const cv::Mat& light)
{
    if (call.contact == "whole" || (call.contact == "auto" && !signals::hasOutside(light))) return {};
    if (call.contact != "auto" && call.contact != "part") return maskOf(call.contact, light.size());
    const cv::Mat calm = (cv::abs(slopes.x) < 0.05) & (cv::abs(slopes.y) < 0.05);
    return signals::contactOf(signals::withoutTilt(signals::integrate(slopes, pitch), calm), slopes);
}

Reconstruction fromFrame(const HeightCall& call, const signals::Calibration& calibration, const cv::Mat& reference,
                         const std::string& name, const cv::Mat& frame)
{
    const signals::Pitch pitch{calibration.mmPerPixel, calibration.mmPerPixel};
    Reconstruction result{name, signals::slopesFromFrame(frame, reference, calibration), {}, {}};
    const cv::Mat contact = contactPlaces(call, result.slopes, pitch, signals::lightOf(frame, reference, calibration.light));
    result.facts = {{"from", "frame"},
                    {"calibration", call.calibration},
                    {"map", signals::kindOf(calibration.map)},
                    {"pitch_mm", {pitch.x, pitch.y}}};
    const cv::Mat height = signals::integrate(result.slopes, pitch, signals::SlopeKind::Point, qualityOf(call));
    result.facts["curl_residual"] = signals::curlResidual(result.slopes, height, pitch);
    if (contact.empty()) {
        const auto cutoff = call.cutoffMm > 0 ? std::optional(call.cutoffMm) : calibration.highPassCutoffMm;
        result.heightMm = signals::zeroedRelief(height, pitch, cutoff, calibration.zeroPercentile);
        result.facts["contact"] = "whole frame";
        result.facts["high_pass_cutoff_mm"] = nullptr;
        if (cutoff) result.facts["high_pass_cutoff_mm"] = *cutoff;
        result.facts["zero_percentile"] = calibration.zeroPercentile;
    } else {
        result.heightMm = signals::heightInContact(result.slopes, contact, pitch, qualityOf(call));
        result.facts["contact"] = "part";
        result.facts["contact_share"] = shareOf(contact);
        result.facts["zero"] = "edge of contact; 0 outside, where the gel's shape is not the object's";
    }
    result.facts["saturated_share"] = shareOf(frame.reshape(1) == (frame.depth() == CV_16U ? 65535 : 255));
    return result;
}

/// A frame that the sensor cannot have taken is named before any work.
void requireOfSensor(const std::string& file, const cv::Mat& frame, const cv::Mat& reference)
{
    if (reference.empty() || (frame.size() == reference.size() && frame.type() == reference.type())) return;
    const auto kind = [](const cv::Mat& image) {
        return std::to_string(image.cols) + " x " + std::to_string(image.rows) +
               (image.channels() == 1 ? ", grey, " : ", colour, ") + std::to_string(8 * image.elemSize1()) + " bits";
    };
    throw protocols::badInput(
        {"is no frame of the calibrated sensor (" + kind(frame) + ")", file, kind(reference) + ", as its background", ""});
}

void requireOwnName(const std::string& file, const std::string& name, std::set<std::string>& names)
{
    if (!names.insert(name).second)
        throw protocols::badInput({"another frame has this name too", file, "frames whose results do not overwrite each other",
                                   "rename one, or use another --out"});
}

/// One colour frame each, or as many grey ones, in their order, as the sensor has lamps.
std::vector<Reconstruction> fromFrames(const HeightCall& call)
{
    const auto calibration = signals::readCalibration(call.calibration);
    const cv::Mat reference = referenceOf(call, calibration);
    std::vector<Reconstruction> results;
    std::vector<cv::Mat> lamps;
    std::set<std::string> names;
    for (const auto& file : call.frames) {
        if (fs::is_directory(file)) throw protocols::badInput({"is a folder", file, "a frame", "name the frames in it"});
        const cv::Mat frame = rendering::readPicture(file, decodeByQt);
        const std::string name = fs::path(file).stem().string();
        requireOfSensor(file, frame, reference);
        requireOwnName(file, name, names);
        if (frame.channels() == calibration.channels && calibration.channels != 1) {
            results.push_back(fromFrame(call, calibration, reference, name, frame));
            continue;
        }
        lamps.push_back(frame);
        if (static_cast<int>(lamps.size()) < calibration.channels) continue;
        results.push_back(fromFrame(call, calibration, reference, name, signals::oneFrame(lamps)));
        lamps.clear();
    }
    if (!lamps.empty())
        throw protocols::badInput({std::to_string(lamps.size()) + " frames are left over", call.frames.back(),
                                   std::to_string(calibration.channels) + " frames a measurement, one a lamp", ""});
    return results;
}

void write(const HeightCall& call, Reconstruction result)
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
    if (!call.gradients.empty())
        write(call, fromGradients(call));
    else if (!call.normals.empty())
        write(call, fromNormals(call));
    else
        for (auto& result : fromFrames(call)) write(call, std::move(result));
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
