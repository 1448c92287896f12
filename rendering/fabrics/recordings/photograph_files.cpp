#include "rendering/fabrics/recordings/photograph_files.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/recordings/import_stage.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"

namespace rendering::fabrics {

namespace {

constexpr std::string_view imageEndings[] = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
constexpr int smallestSidePx = 16;
constexpr double brightestWord = 65535, leastBrightest = 1 << 12;
constexpr double wordsPerByte = 257;  ///< white is 65535 of 16 bits and 255 of 8

cv::Mat readPhotographTiff(const std::filesystem::path& file)
{
    cv::Mat image = readColourTiff(file);
    if (image.depth() != CV_8U && image.depth() != CV_16U)
        throw protocols::badInput({"holds numbers with a fraction, which have no white", file.string(), "a TIFF of 8 or 16 bits",
                                   "export the photograph with 8 or 16 bits"});
    return image;
}

}  // namespace

std::span<const std::string_view> photographEndings() { return imageEndings; }

cv::Mat inEightBits(const cv::Mat& picture, const std::filesystem::path& file)
{
    if (picture.depth() != CV_16U) return picture;
    double brightest = 0;
    cv::minMaxLoc(picture.reshape(1), nullptr, &brightest);
    if (brightest < leastBrightest)
        throw protocols::badInput(
            {"its brightest value is " + std::to_string(std::lround(brightest)) + " of " +
                 std::to_string(std::lround(brightestWord)) + ", so that " +
                 std::to_string(std::lround(brightest / wordsPerByte) + 1) + " grey levels at most would be left of its 16 bits",
             file.string(), "white at 65535; values of 10 or 12 bits need the factor 64 or 16",
             "multiply the values of all pictures of this camera by one factor, or export them with 8 bits"});
    cv::Mat bytes;
    picture.convertTo(bytes, CV_8U, 1 / wordsPerByte);
    return bytes;
}

cv::Mat readPhotographFile(const std::filesystem::path& file, const DecodeOther& decodeOther)
{
    cv::Mat image;
    const std::string ending = lowerCase(file.extension().string());
    if (ending == ".png")
        image = readPng(file);
    else if (ending == ".tif" || ending == ".tiff")
        image = readPhotographTiff(file);
    else if (decodeOther)
        image = decodeOther(file);
    else
        throw protocols::badInput(
            {"is neither PNG nor TIFF, and there is no decoder for it", file.string(), "a PNG image", "convert it to PNG"});
    if (image.empty() || std::min(image.rows, image.cols) < smallestSidePx)
        throw protocols::badInput({"is " + std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels",
                                   file.string(), "at least 16 x 16 pixels", "export it at a larger size"});
    image = inEightBits(image, file);
    if (image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2RGB);
    return image;
}

void makePhotographSet(const NewPhotographSet& request, const std::function<void(int, int)>& progress)
{
    std::error_code unknown;
    if (std::filesystem::exists(std::filesystem::symlink_status(request.out, unknown)))
        throw protocols::badInput({"this folder or file exists already", request.out.string(), "a name that is free",
                                   "choose another name; nothing was written"});
    if (request.photographs.empty())
        throw protocols::badInput({"there are no photographs", request.out.string(), "at least one", "choose photographs"});
    ImportStage stage(request.out);
    stage.dataset().cameraMmPerPixel = request.mmPerPixel;
    const int total = static_cast<int>(request.photographs.size());
    for (int done = 0; done < total; ++done) {
        if (progress) progress(done, total);
        const SourceFile& source = request.photographs[static_cast<std::size_t>(done)];
        const cv::Mat picture = readPhotographFile(source.file, request.decodeOther);
        const auto slot = stage.addSample(stage.fabricFor(source.fabricName, std::nullopt), Modality::Visual);
        writePng(slot.file, picture, protocols::Sync::Later);
    }
    if (progress) progress(total, total);
    stage.commit();
}

}  // namespace rendering::fabrics
