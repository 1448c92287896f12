#include "rendering/scans/scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"
#include "rendering/scans/normal_map.h"
#include "rendering/signals/periodic_slopes.h"

namespace rendering::scans {

namespace {

constexpr int leastSidePx = 64;
constexpr int mostSideRatio = mostScanSidePx / leastSidePx;  ///< a longer image would be too narrow once it is reduced
constexpr double mostShapeError = 0.01;                      ///< of the ratio of the sides of two images of one fabric
constexpr double mostSeamRatio = 1.6;  ///< difference across a border that meets, over that of inner neighbours

std::string sizeText(const cv::Mat& image) { return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " px"; }

cv::Mat resized(const cv::Mat& image, cv::Size size)
{
    if (image.empty() || image.size() == size) return image;
    cv::Mat result;
    const bool isSmaller = size.area() < image.size().area();
    cv::resize(image, result, size, 0, 0, isSmaller ? cv::INTER_AREA : cv::INTER_CUBIC);
    return result;
}

/// The pixels of a file, of 8 or 16 bits or float, at most mostScanSidePx a side.
cv::Mat readMap(const std::filesystem::path& file, const fabrics::DecodeOther& decodeOther)
{
    const std::string ending = fabrics::lowerCase(file.extension().string());
    cv::Mat image = ending == ".png"                        ? readPng(file)
                    : ending == ".tif" || ending == ".tiff" ? readColourTiff(file)
                                                            : fabrics::readPhotographFile(file, decodeOther);
    if (std::min(image.rows, image.cols) < leastSidePx)
        throw protocols::badInput(
            {"is " + sizeText(image), file.string(), "at least 64 px a side", "export it at a larger size"});
    if (std::max(image.rows, image.cols) > mostSideRatio * std::min(image.rows, image.cols))
        throw protocols::badInput({"is " + sizeText(image) + ", a narrow strip", file.string(),
                                   "a longer side of at most " + std::to_string(mostSideRatio) + " times the shorter one",
                                   "cut out a part that is nearer to a square"});
    const double factor = double(mostScanSidePx) / std::max(image.rows, image.cols);
    return factor < 1 ? resized(image, {int(std::lround(image.cols * factor)), int(std::lround(image.rows * factor))}) : image;
}

struct ReadMap {
    MapFile source;
    cv::Mat pixels;
};

/// The finest of several files. Of two normal maps of one size the first in the order of their names is taken, so GL before DX.
std::optional<ReadMap> finest(const std::vector<MapFile>& files, const fabrics::DecodeOther& decodeOther)
{
    std::optional<ReadMap> best;
    for (const MapFile& file : files) {
        ReadMap map{file, readMap(file.file, decodeOther)};
        if (!best || map.pixels.cols > best->pixels.cols) best = std::move(map);
    }
    return best;
}

/// The coarsest colour that is not coarser than `columns`, else the finest.
ReadMap colourFor(const std::vector<MapFile>& files, int columns, const fabrics::DecodeOther& decodeOther)
{
    std::optional<ReadMap> best;
    for (const MapFile& file : files) {
        ReadMap map{file, readMap(file.file, decodeOther)};
        const bool isEnough = map.pixels.cols >= columns;
        const bool isBetter = !best || (best->pixels.cols >= columns ? isEnough && map.pixels.cols < best->pixels.cols
                                                                     : map.pixels.cols > best->pixels.cols);
        if (isBetter) best = std::move(map);
    }
    return std::move(*best);
}

cv::Mat eightBitColour(const ReadMap& map)
{
    cv::Mat colour = map.pixels;
    if (colour.depth() == CV_32F)
        throw protocols::badInput(
            {"holds float numbers", map.source.file.string(), "a colour image of 8 or 16 bits", "export it again"});
    colour = fabrics::inEightBits(colour, map.source.file);
    if (colour.channels() == 1) cv::cvtColor(colour, colour, cv::COLOR_GRAY2RGB);
    return colour;
}

/// Displacement from 0 to 1 of its own range; CV_32FC1.
cv::Mat unitDisplacement(const ReadMap& map)
{
    cv::Mat values;
    map.pixels.convertTo(values, CV_32F);
    if (values.channels() == 3) cv::extractChannel(values, values, 0);
    if (!cv::checkRange(values))  // minMaxLoc skips NaN, and one would spread over the whole surface.
        throw protocols::badInput({"holds heights that are not finite", map.source.file.string(), "a number in every pixel",
                                   "export the displacement again, without gaps"});
    double lowest = 0, highest = 0;
    cv::minMaxLoc(values, &lowest, &highest);
    if (!(highest - lowest >= std::numeric_limits<float>::min()))
        throw protocols::badInput({"has the same height everywhere", map.source.file.string(), "a displacement map",
                                   "choose the displacement of the fabric"});
    values.convertTo(values, CV_32F, 1 / (highest - lowest), -lowest / (highest - lowest));
    return values;
}

/// Mean difference across the borders over the mean difference of inner neighbours; about 1 where the borders meet, nullopt for
/// a map without differences.
std::optional<double> seamRatio(const cv::Mat& map)
{
    const auto ratio = [](const cv::Mat& lines) -> std::optional<double> {
        const auto difference = [&](int a, int b) { return cv::norm(lines.row(a), lines.row(b), cv::NORM_L1); };
        double inner = 0;
        int count = 0;
        for (int row = 0; row + 1 < lines.rows; row += std::max(1, lines.rows / 64), ++count) inner += difference(row, row + 1);
        return inner > 0 ? std::optional(difference(0, lines.rows - 1) * count / inner) : std::nullopt;
    };
    const auto down = ratio(map), across = ratio(map.t());
    return down && across ? std::optional(std::max(*down, *across)) : std::nullopt;
}

/// Colour decides: on real normal maps a thin seam is visible although the cloth continues.
bool doBordersMeet(const cv::Mat& colour, const Scan& scan)
{
    const auto seen = seamRatio(colour), felt = seamRatio(scan.slopes.x);
    return seen.value_or(felt.value_or(1)) <= mostSeamRatio;
}

void requireShape(const ReadMap& map, const ReadMap& colour)
{
    const double ratio = double(map.pixels.cols) * colour.pixels.rows / (double(map.pixels.rows) * colour.pixels.cols);
    if (std::abs(ratio - 1) <= mostShapeError) return;
    throw protocols::badInput({"is " + sizeText(map.pixels) + ", another shape than the colour, " + sizeText(colour.pixels) +
                                   " in " + colour.source.file.filename().string(),
                               map.source.file.string(), "images of one tile", "export both at one size, or remove one"});
}

std::string depthText(const cv::Mat& image)
{
    return sizeText(image) + ", " + (image.depth() == CV_32F ? "float" : std::to_string(8 * image.elemSize1()) + " bits");
}

void addNormals(Scan& scan, const ReadMap& normals, const cv::Mat& displacement)
{
    scan.slopes = slopesOfNormals(normals.pixels, normals.source.file.string());
    const GreenSign green = greenSignOf(scan.slopes, displacement, normals.source.green);
    if (!green.isUp) scan.slopes.y *= -1;
    const bool isContradicted = normals.source.green != GreenUp::Unstated && (normals.source.green == GreenUp::Yes) != green.isUp;
    scan.remarks.push_back(normals.source.file.filename().string() + ", " + depthText(normals.pixels) + ": green points " +
                           (green.isUp ? "up (OpenGL)" : "down (DirectX)") +
                           (isContradicted ? ", although the name says otherwise" : "") + "; " + green.remark);
}

void integrateSlopes(Scan& scan, double tileMm)
{
    const double pitch = tileMm / scan.slopes.x.cols;
    if (scan.bordersMeet)
        scan.surface = signals::integratePeriodic(scan.slopes, {pitch, pitch});
    else
        scan.surface = signals::withoutTilt(
            signals::integrate(scan.slopes, {pitch, pitch}, signals::SlopeKind::Point, signals::IntegrationQuality::Fast), {});
}

/// The surface of a displacement whose amplitude is unknown, and slopes of a usual steepness.
void takeDisplacement(Scan& scan, const ReadMap& file, const cv::Mat& displacement)
{
    scan.surface = displacement;
    scan.surfaceInMm = false;
    scan.slopes = signals::periodicSlopes(displacement, {1, 1});
    const double power = (scan.slopes.x.dot(scan.slopes.x) + scan.slopes.y.dot(scan.slopes.y)) / double(displacement.total());
    const double factor = assumedRmsSlope / std::sqrt(power);
    scan.slopes.x *= factor;
    scan.slopes.y *= factor;
    scan.remarks.push_back(
        file.source.file.filename().string() + ", " + depthText(file.pixels) +
        ": no normals, so the amplitude of the height is unknown and serves for correlation only; relit with slopes of " +
        protocols::fixed(assumedRmsSlope, 2) + " RMS, which is a guess");
}

void addAgreement(Scan& scan, const ReadMap& file, const cv::Mat& displacement)
{
    const double correlation = heightCorrelation(scan.surface, displacement);
    scan.remarks.push_back(file.source.file.filename().string() + ", " + depthText(file.pixels) +
                           ": correlates with the integrated normals at " + protocols::fixed(correlation, 3) +
                           (correlation < 0 ? ", so one of the two has hills for valleys: check a picture of the relief" : ""));
}

}  // namespace

Scan readScan(const ScanFiles& files, double tileMm, const fabrics::DecodeOther& decodeOther)
{
    Scan scan;
    const auto normals = finest(files.normals, decodeOther), displacement = finest(files.displacement, decodeOther);
    const ReadMap& shape = normals ? *normals : *displacement;
    const ReadMap colour = colourFor(files.colour, shape.pixels.cols, decodeOther);
    const cv::Mat heights = displacement ? unitDisplacement(*displacement) : cv::Mat();
    for (const auto* map : {&normals, &displacement})
        if (*map) requireShape(**map, colour);
    scan.remarks.push_back(colour.source.file.filename().string() + ", " + depthText(colour.pixels) + ": colour");
    if (normals) {
        addNormals(scan, *normals, heights);
        scan.bordersMeet = doBordersMeet(colour.pixels, scan);
        integrateSlopes(scan, tileMm);
        if (displacement) addAgreement(scan, *displacement, heights);
    } else {
        takeDisplacement(scan, *displacement, heights);
        scan.bordersMeet = doBordersMeet(colour.pixels, scan);
    }
    if (!scan.bordersMeet)
        scan.remarks.push_back("the borders do not meet, so this is no seamless tile; it is integrated with free borders");
    const cv::Size grid = colour.pixels.cols < scan.surface.cols ? colour.pixels.size() : scan.surface.size();
    scan.colour = resized(eightBitColour(colour), grid);
    scan.surface = resized(scan.surface, grid);
    scan.slopes = {resized(scan.slopes.x, grid), resized(scan.slopes.y, grid)};
    scan.mmPerPixel = tileMm / grid.width;
    return scan;
}

}  // namespace rendering::scans
