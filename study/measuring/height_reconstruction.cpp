#include "study/measuring/height_reconstruction.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "rendering/images/image_io.h"

namespace study::measuring {

namespace {

namespace fs = std::filesystem;
namespace signals = rendering::signals;
using nlohmann::ordered_json;

constexpr double calmSlope = 0.05;  ///< mm/mm; places with less slope lie flat
constexpr int trialSidePx = 1024;   ///< part of a normal map that decides which way its y points

std::string sizeText(cv::Size size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

/// Mask from an image, CV_8UC1: 255 where the pixel is not 0.
cv::Mat maskOf(const fs::path& file, cv::Size size)
{
    const cv::Mat mask = rendering::readImage(file);
    if (mask.size() != size || mask.channels() != 1)
        throw protocols::badInput(
            {"the mask has " + sizeText(mask.size()) + " pixels and " + std::to_string(mask.channels()) + " channels",
             file.string(), sizeText(size) + " grey pixels, 0 where nothing was measured", "use a mask of this size"});
    return mask != 0;
}

double shareOf(const cv::Mat& places)
{
    return static_cast<double>(cv::countNonZero(places)) / static_cast<double>(places.total());
}

/// The slopes that count: NaN where `places` is 0. Without places all do, and nothing is copied.
signals::Slopes slopesAt(const cv::Mat& places, const signals::Slopes& slopes)
{
    if (places.empty()) return slopes;
    constexpr double notMeasured = std::numeric_limits<double>::quiet_NaN();
    const cv::Mat others = places == 0;
    signals::Slopes counted{slopes.x.clone(), slopes.y.clone()};
    counted.x.setTo(notMeasured, others);
    counted.y.setTo(notMeasured, others);
    return counted;
}

/// The places of the mask; empty where none was named.
cv::Mat placesOf(const SlopeSampling& sampling, const signals::Slopes& slopes)
{
    return sampling.mask.empty() ? cv::Mat() : maskOf(sampling.mask, slopes.x.size());
}

/// Integrates slopes as they were given, at the places that count. The lowest place becomes 0; nothing else is changed.
void integrateAll(Reconstruction& result, const signals::Slopes& counted, const SlopeSampling& sampling,
                  const HeightOptions& options)
{
    const signals::Pitch& pitch = sampling.pitch;
    const signals::SlopeKind kind = sampling.kind;
    const cv::Mat measured = signals::measuredPlaces(counted);
    const bool whole = cv::countNonZero(measured) == static_cast<int>(measured.total());
    const cv::Mat integral = whole ? signals::integrate(counted, pitch, kind, options.quality)
                                   : signals::integrateAround(counted, measured, pitch, kind);
    cv::Mat height = integral;
    if (options.cutoffMm) height = signals::withoutLowFrequency(height, pitch, *options.cutoffMm);
    double low = 0;
    cv::minMaxLoc(height, &low);
    height.convertTo(result.heightMm, CV_32F, 1, -low);
    if (!cv::checkRange(result.heightMm))
        throw protocols::badInput({"the integrated height exceeds the range of 32-bit numbers", result.name, "slopes in mm/mm",
                                   "check the unit of the slopes"});
    result.facts["pitch_mm"] = {pitch.x, pitch.y};
    result.facts["missing_share"] = 1 - shareOf(measured);
    result.facts["curl_residual"] = signals::curlResidual(counted, integral, pitch, kind);
    result.facts["high_pass_cutoff_mm"] = nullptr;
    if (options.cutoffMm) result.facts["high_pass_cutoff_mm"] = *options.cutoffMm;
    result.facts["zero"] = "lowest place";
}

/// The part of the map, at most trialSidePx wide and high, with the most measured places; of several the first.
cv::Rect trialPart(const cv::Mat& measured)
{
    const cv::Rect map(cv::Point(), measured.size());
    cv::Rect best;
    int most = -1;
    for (int y = 0; y < map.height; y += trialSidePx)
        for (int x = 0; x < map.width; x += trialSidePx) {
            const cv::Rect part = cv::Rect(x, y, trialSidePx, trialSidePx) & map;
            const int count = cv::countNonZero(measured(part));
            if (count <= most) continue;
            best = part;
            most = count;
        }
    return best;
}

/// The wrong direction of y does not give the slopes of a surface, so a larger share of them cannot be integrated. A part of
/// the map is enough to see the difference.
bool pointsDown(const signals::Slopes& slopes, const signals::Pitch& pitch, NormalsY y, ordered_json& facts)
{
    if (y != NormalsY::Auto) return y == NormalsY::Down;
    const cv::Rect part = trialPart(signals::measuredPlaces(slopes));
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

/// Empty for a sensor that is calibrated against the frame's own light.
cv::Mat backgroundFor(const FramesRequest& request, const signals::Calibration& calibration, const rendering::Decode& decodeOther)
{
    if (calibration.light == signals::LightMeasure::AgainstOwnLight) return {};
    fs::path file = request.background;
    if (file.empty()) file = request.calibration.parent_path() / (request.calibration.stem().string() + "-background.png");
    if (!fs::exists(file))
        throw protocols::badInput({"there is no frame of the untouched sensor", file.string(), "--background PNG",
                                   "name the frame that was taken before the presses"});
    const cv::Mat background = rendering::readPicture(file, decodeOther);
    if (calibration.sensor)
        if (const auto difference = signals::differenceOf(*calibration.sensor, signals::appearanceOf(background)))
            throw protocols::badInput({"this background is not of the calibrated sensor: " + *difference, file.string(),
                                       "a frame of the sensor of " + request.calibration.string(),
                                       "calibrate this sensor, or name its own background"});
    return background;
}

/// Its places are empty where the whole frame is in contact.
signals::Contact contactIn(const ContactChoice& contact, const signals::Slopes& slopes, const signals::Pitch& pitch,
                           const cv::Mat& light)
{
    using Where = ContactChoice::Where;
    if (contact.where == Where::Mask) return {maskOf(contact.mask, light.size()), 0};
    if (contact.where == Where::Whole || (contact.where == Where::Auto && !signals::hasOutside(light))) return {};
    const cv::Mat calm = (cv::abs(slopes.x) < calmSlope) & (cv::abs(slopes.y) < calmSlope);
    return signals::contactOf(signals::withoutTilt(signals::integrate(slopes, pitch), calm), light);
}

void settleWholeFrame(Reconstruction& result, const cv::Mat& height, const signals::Pitch& pitch,
                      const signals::Calibration& calibration, const HeightOptions& options)
{
    const auto cutoff = options.cutoffMm ? options.cutoffMm : calibration.highPassCutoffMm;
    result.heightMm = signals::zeroedRelief(height, pitch, cutoff, calibration.zeroPercentile);
    result.facts["contact"] = "whole frame";
    result.facts["high_pass_cutoff_mm"] = nullptr;
    if (cutoff) result.facts["high_pass_cutoff_mm"] = *cutoff;
    result.facts["zero_percentile"] = calibration.zeroPercentile;
}

/// Turns frames of one calibrated sensor into heights.
class FrameReader {
public:
    FrameReader(const FramesRequest& request, const HeightOptions& options, const rendering::Decode& decodeOther)
        : m_request(request),
          m_options(options),
          m_calibration(signals::readCalibration(request.calibration)),
          m_background(backgroundFor(request, m_calibration, decodeOther))
    {
    }

    int channels() const { return m_calibration.channels; }

    /// Refuses a frame that the sensor cannot have taken, before any work.
    void requireOfSensor(const fs::path& file, const cv::Mat& frame) const
    {
        if (m_background.empty()) return;
        if (frame.size() == m_background.size() && frame.type() == m_background.type()) {
            if (const auto difference = signals::foreignLight(m_background, frame))
                throw protocols::badInput({"the calibrated sensor cannot have taken this frame: " + *difference, file.string(),
                                           "the light of its background, where nothing touches the sensor",
                                           "name frames of this sensor, or its own background with --background"});
            return;
        }
        const auto kind = [](const cv::Mat& image) {
            return sizeText(image.size()) + (image.channels() == 1 ? ", grey, " : ", colour, ") +
                   std::to_string(8 * image.elemSize1()) + " bits";
        };
        throw protocols::badInput({"the calibrated sensor cannot have taken this frame (" + kind(frame) + ")", file.string(),
                                   kind(m_background) + ", as its background", "name frames of this sensor"});
    }

    Reconstruction heightOf(const std::string& name, const cv::Mat& frame) const
    {
        const signals::Pitch pitch{m_calibration.mmPerPixel, m_calibration.mmPerPixel};
        Reconstruction result{name, signals::slopesFromFrame(frame, m_background, m_calibration), {}, {}};
        const cv::Mat light = signals::lightOf(frame, m_background, m_calibration.light);
        const auto contact = contactIn(m_request.contact, result.slopes, pitch, light);
        result.facts = {{"from", "frame"},
                        {"calibration", m_request.calibration.string()},
                        {"map", signals::kindOf(m_calibration.map)},
                        {"pitch_mm", {pitch.x, pitch.y}}};
        const cv::Mat height = signals::integrate(result.slopes, pitch, signals::SlopeKind::Point, m_options.quality);
        result.facts["curl_residual"] = signals::curlResidual(result.slopes, height, pitch);
        if (contact.places.empty()) {
            settleWholeFrame(result, height, pitch, m_calibration, m_options);
        } else {
            result.heightMm = signals::heightInContact(result.slopes, contact.places, pitch, m_options.quality);
            result.facts["contact"] = "part";
            result.facts["contact_share"] = shareOf(contact.places);
            if (contact.levelErrorMm > 0) result.facts["level_error_mm"] = contact.levelErrorMm;
            result.facts["zero"] = "edge of contact; 0 outside, where the gel's shape is not the object's";
        }
        result.facts["saturated_share"] = shareOf(frame.reshape(1) == (frame.depth() == CV_16U ? 65535 : 255));
        return result;
    }

private:
    const FramesRequest& m_request;
    const HeightOptions& m_options;
    signals::Calibration m_calibration;
    cv::Mat m_background;
};

}  // namespace

Reconstruction fromGradients(const fs::path& alongX, const fs::path& alongY, const SlopeSampling& sampling,
                             const HeightOptions& options)
{
    Reconstruction result{"height", {rendering::readImage(alongX), rendering::readImage(alongY)}, {}, {}};
    for (const auto& [slope, file] : {std::pair(&result.slopes.x, &alongX), std::pair(&result.slopes.y, &alongY)})
        if (slope->channels() != 1 || (slope->depth() != CV_32F && slope->depth() != CV_64F))
            throw protocols::badInput({"this is a picture, and no file of slopes", file->string(),
                                       "one channel of floating-point numbers, as .npy or .tiff",
                                       "name the slopes in mm per mm; --normals reads a picture of normals"});
    if (result.slopes.x.size() != result.slopes.y.size())
        throw protocols::badInput({"the slopes along x and y differ in size", alongY.string(),
                                   sizeText(result.slopes.x.size()) + " numbers, as along x",
                                   "name the slopes of one measurement"});
    const char* const kinds[] = {"point", "central", "forward"};
    result.facts = {{"from", "gradients"}, {"kind", kinds[static_cast<int>(sampling.kind)]}};
    integrateAll(result, slopesAt(placesOf(sampling, result.slopes), result.slopes), sampling, options);
    return result;
}

Reconstruction fromNormals(const fs::path& map, NormalsY y, const SlopeSampling& sampling, const HeightOptions& options,
                           const rendering::Decode& decodeOther)
{
    Reconstruction result{map.stem().string(), signals::slopesFromNormals(rendering::readPicture(map, decodeOther)), {}, {}};
    result.facts = {{"from", "normals"}, {"kind", "point"}};
    const cv::Mat places = placesOf(sampling, result.slopes);
    const bool isDown = pointsDown(slopesAt(places, result.slopes), sampling.pitch, y, result.facts);
    if (isDown) result.slopes.y = -result.slopes.y;
    result.facts["normals_y"] = isDown ? "down" : "up";
    integrateAll(result, slopesAt(places, result.slopes), {sampling.pitch, signals::SlopeKind::Point, sampling.mask}, options);
    return result;
}

std::vector<Reconstruction> fromFrames(const FramesRequest& request, const HeightOptions& options,
                                       const rendering::Decode& decodeOther)
{
    const FrameReader reader(request, options, decodeOther);
    std::vector<Reconstruction> results;
    std::vector<cv::Mat> lamps;
    std::set<std::string> names;
    for (const auto& file : request.frames) {
        if (fs::is_directory(file)) throw protocols::badInput({"is a folder", file.string(), "a frame", "name the frames in it"});
        const cv::Mat frame = rendering::readPicture(file, decodeOther);
        const std::string name = file.stem().string();
        reader.requireOfSensor(file, frame);
        if (!names.insert(name).second)
            throw protocols::badInput({"another frame has this name too", file.string(),
                                       "frames whose results do not overwrite each other", "rename one, or use another --out"});
        if (frame.channels() == reader.channels() && reader.channels() != 1) {
            results.push_back(reader.heightOf(name, frame));
            continue;
        }
        lamps.push_back(frame);
        if (static_cast<int>(lamps.size()) < reader.channels()) continue;
        results.push_back(reader.heightOf(name, signals::oneFrame(lamps)));
        lamps.clear();
    }
    if (!lamps.empty())
        throw protocols::badInput({std::to_string(lamps.size()) + " frames are left over", request.frames.back().string(),
                                   std::to_string(reader.channels()) + " frames a measurement, one for each lamp",
                                   "add the missing frames, or leave these out"});
    return results;
}

}  // namespace study::measuring
