#include "study/looking/read_signal.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/composition/friction_image.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_io.h"
#include "rendering/images/image_tiff.h"
#include "rendering/images/true_map.h"
#include "study/looking/open_study.h"
#include "study/looking/place_in_dataset.h"
#include "study/looking/read_trace.h"

namespace study::looking {

namespace {

namespace fs = std::filesystem;

constexpr double missingValue = std::numeric_limits<double>::quiet_NaN();
constexpr double missingMarkerMm = -1e9;  // instruments write -1e10

std::optional<double> pitchIn(const PlaceInDataset& place)
{
    if (place.signal == "visual" || place.signal == "surface")
        return rendering::fabrics::PhotographViews(place.dataset).mmPerPixel(protocols::FabricId(place.fabric), place.index);
    const bool isTactile = place.signal == "tactile" || place.signal == "height";
    return isTactile ? place.dataset.tactileMmPerPixel : std::nullopt;
}

std::string endingOf(const fs::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::string sizeOf(const cv::Mat& image) { return std::to_string(image.cols) + " × " + std::to_string(image.rows); }

/// Marks of clipped pixels. Bit 0: a channel has the lowest value; bit 1: a channel has the highest value.
cv::Mat clippedIn(const cv::Mat& image, const StoredRange& storedRange)
{
    cv::Mat marks = cv::Mat::zeros(image.size(), CV_8UC1);
    std::vector<cv::Mat> channels;
    cv::split(image, channels);
    for (const cv::Mat& channel : channels) {
        marks |= (channel == storedRange.lowest) & 1;
        marks |= (channel == storedRange.highest) & 2;
    }
    return marks;
}

SeenMap mapOfImage(const cv::Mat& image)
{
    SeenMap map;
    map.storedRange = image.depth() == CV_8U ? StoredRange{0, 255} : StoredRange{0, 65535};
    map.unit = "grey level";
    map.clipped = clippedIn(image, *map.storedRange);
    cv::Mat grey = image;
    if (image.channels() == 3) {
        image.convertTo(map.colours, CV_8U, 255.0 / map.storedRange->highest);
        cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
    }
    grey.convertTo(map.values, CV_32F);
    return map;
}

SeenMap mapOfNumbers(const cv::Mat& numbers, const std::string& unit)
{
    SeenMap map;
    map.unit = unit;
    numbers.convertTo(map.values, CV_32F);
    for (float& value : cv::Mat_<float>(map.values))
        if (!std::isfinite(value) || (unit == "mm" && value <= missingMarkerMm)) value = static_cast<float>(missingValue);
    return map;
}

SeenSignal seenRow(const cv::Mat& row, const std::string& title, const std::string& unit)
{
    SeenTrace trace;
    cv::Mat values;
    row.convertTo(values, CV_64F);
    for (int i = 0; i < values.cols; ++i) {
        const double value = values.at<double>(i);
        trace.places.push_back(i);
        trace.values.push_back(std::isfinite(value) ? value : missingValue);
    }
    trace.placeUnit = "samples";
    trace.quantity = unit.empty() ? "value" : unit;
    return {title, "array of one row, " + std::to_string(values.cols) + " values", std::move(trace)};
}

/// Whether the image has the size of the display. Its pixels then have the pitch of the display.
bool isOfTheGlass(const cv::Mat& image)
{
    return image.channels() == 1 && image.size() == cv::Size(rendering::displayWidthPx, rendering::displayHeightPx);
}

std::string kindOfImage(const cv::Mat& image, const std::optional<PlaceInDataset>& place)
{
    const std::string depth = image.depth() == CV_8U ? ", 8 bits" : ", 16 bits";
    if (place && place->signal == "visual") return "photograph, " + sizeOf(image) + depth;
    if (place && place->signal == "tactile") return "tactile frame, " + sizeOf(image) + depth;
    const char* kind = image.channels() == 3 ? "colour picture, " : isOfTheGlass(image) ? "friction image, " : "grey picture, ";
    return kind + sizeOf(image) + depth;
}

/// Reads a profilometer file, which contains its pitch.
SeenSignal readProfilometer(const fs::path& file, const ReadingOptions& options)
{
    const rendering::TrueMap read = rendering::readTrueMap(file);
    SeenMap map = mapOfNumbers(read.heightMm, "mm");
    map.mmPerPixel = options.mmPerPixel.value_or(read.xPitchMm);
    map.rowPitch = std::clamp(read.yPitchMm / read.xPitchMm, 0.01, 100.0);  // extreme ratios would make the picture unreadable
    return {file.filename().string(), "height, " + sizeOf(read.heightMm), std::move(map)};
}

cv::Mat decoded(const fs::path& file, const ReadingOptions& options)
{
    const std::string kind = endingOf(file);
    const bool isForeign = kind == ".jpg" || kind == ".jpeg" || kind == ".bmp" || kind == ".webp";
    if (isForeign && options.decode) return options.decode(file);
    return kind == ".tif" || kind == ".tiff" ? rendering::readColourTiff(file) : rendering::readImage(file);
}

std::optional<double> pitchOf(const cv::Mat& image, const std::optional<PlaceInDataset>& place, const ReadingOptions& options)
{
    if (options.mmPerPixel) return options.mmPerPixel;
    if (place) return pitchIn(*place);
    const bool isShown = image.depth() == CV_8U && isOfTheGlass(image);
    return isShown ? std::optional(rendering::displayMmPerPixel) : std::nullopt;
}

bool hasUnknownAmplitude(const std::optional<PlaceInDataset>& place)
{
    return place && place->signal == "surface" && !place->dataset.fabric(protocols::FabricId(place->fabric)).surfaceInMm;
}

std::string kindOfNumbers(const SeenMap& map)
{
    const std::string kind = map.unit == "mm" ? "height, " : map.unit == "mm/mm" ? "gradient, " : "map, ";
    return kind + sizeOf(map.values);
}

SeenSignal readMap(const fs::path& file, const ReadingOptions& options)
{
    const cv::Mat image = decoded(file, options);
    if (image.empty())
        throw protocols::badInput({"contains no numbers", file.string(), "at least one pixel", "write the file again"});
    const auto place = placeInDataset(file);
    const bool isImage = image.depth() == CV_8U || image.depth() == CV_16U;
    const bool isArray = endingOf(file) == ".npy";
    if (!isImage && image.channels() != 1)
        throw protocols::badInput({"has " + std::to_string(image.channels()) + " numbers per pixel", file.string(),
                                   "one number per pixel, or an image with 8 or 16 bits",
                                   "write one channel to a file of its own"});
    if (isArray && image.rows == 1 && image.cols > 1) return seenRow(image, titleOf(file, place), options.unit);
    const std::string usualUnit = isArray ? "mm/mm" : hasUnknownAmplitude(place) ? "of the range" : "mm";
    SeenMap map = isImage ? mapOfImage(image) : mapOfNumbers(image, options.unit.empty() ? usualUnit : options.unit);
    map.mmPerPixel = pitchOf(image, place, options);
    map.beginsAtZero = place && place->signal == "height";
    const std::string kind = isImage ? kindOfImage(image, place) : kindOfNumbers(map);
    return {titleOf(file, place), kind, std::move(map)};
}

}  // namespace

SeenSignal readSignal(const fs::path& file, const ReadingOptions& options)
{
    requireNotOfOpenStudy(file);
    const std::string kind = endingOf(file);
    if (kind == ".csv") return readTrace(file, options);
    return kind == ".tmd" ? readProfilometer(file, options) : readMap(file, options);
}

SeenSignal seenHeight(const cv::Mat& heightMm, std::optional<double> mmPerPixel, const std::string& title,
                      const std::string& origin)
{
    SeenMap map = mapOfNumbers(heightMm, "mm");
    map.mmPerPixel = mmPerPixel;
    return {title, "height, " + sizeOf(heightMm) + ", " + origin, std::move(map)};
}

}  // namespace study::looking
