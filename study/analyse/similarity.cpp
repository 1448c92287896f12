#include "study/analyse/similarity.h"

#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <span>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "rendering/images/image_io.h"
#include "rendering/signals/grey.h"
#include "stats/metrics/image_metrics.h"
#include "stats/metrics/trace_error.h"
#include "study/analyse/csv_column.h"
#include "study/analyse/statistic_json.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

bool isTrace(const std::filesystem::path& file) { return file.extension() == ".csv"; }

std::string bothNames(const std::filesystem::path& a, const std::filesystem::path& b)
{
    return a.string() + " and " + b.string();
}

std::vector<double> readOneColumn(const std::filesystem::path& file)
{
    const auto table = protocols::readForeignTable(file).table;
    if (table.columns.size() != 1)
        throw protocols::badInput({"has " + std::to_string(table.columns.size()) + " columns", file.string(),
                                   "a trace of one column", "write the trace as one column"});
    return readColumn(file, table.columns.front());
}

struct GreyImage {
    cv::Mat values;               ///< CV_64FC1
    std::optional<double> range;  ///< none for floating-point values
};

GreyImage readGrey(const std::filesystem::path& file)
{
    cv::Mat image = rendering::readImage(file);
    GreyImage loaded;
    if (image.depth() == CV_8U)
        loaded.range = 255;
    else if (image.depth() == CV_16U)
        loaded.range = 65535;
    if (image.channels() == 3) {
        const int depth = image.depth();
        rendering::signals::grey(image).convertTo(image, depth);  // rounds, as OpenCV's own conversion does
    }
    image.convertTo(loaded.values, CV_64F);
    return loaded;
}

ordered_json errorJson(std::span<const double> a, std::span<const double> b)
{
    const auto error = stats::traceError(a, b);
    ordered_json json{{"schema", "vis2hap.metrics/1"}};
    put(json, "mae", error.mae);
    put(json, "mae_over_mean", error.maeOverMean);
    return json;
}

ordered_json ofTraces(const std::filesystem::path& a, const std::filesystem::path& b)
{
    const auto x = readOneColumn(a), y = readOneColumn(b);
    if (x.size() != y.size())
        throw protocols::badInput(
            {"the traces differ in length", bothNames(a, b), "equal numbers of rows", "cut both traces to one length"});
    auto json = errorJson(x, y);
    put(json, "ssim", stats::Value::undefined("SSIM is defined for images"));
    return json;
}

std::string depthText(const GreyImage& image)
{
    if (!image.range) return "floating-point values";
    return *image.range == 255 ? "8 bits" : "16 bits";
}

/// The same surface has other numbers in another depth, so that the errors would be those of the depth.
void requireOneDepth(const GreyImage& first, const GreyImage& second, const std::filesystem::path& a,
                     const std::filesystem::path& b)
{
    if (first.range == second.range) return;
    throw protocols::badInput({"the images differ in depth: " + depthText(first) + " and " + depthText(second), bothNames(a, b),
                               "two images of one depth, or --range L where both have the same units",
                               "convert one of them, or add --range"});
}

ordered_json ofImages(const std::filesystem::path& a, const std::filesystem::path& b, std::optional<double> wantedRange)
{
    const auto first = readGrey(a), second = readGrey(b);
    if (first.values.size() != second.values.size())
        throw protocols::badInput(
            {"the images differ in size", bothNames(a, b), "equal width and height", "crop or resample one of them"});
    if (!wantedRange) requireOneDepth(first, second, a, b);
    const auto range = wantedRange ? wantedRange : second.range;
    if (!range)
        throw protocols::badInput(
            {"the image has floating-point values", b.string(), "--range L, the dynamic range that SSIM needs", "add --range"});
    const std::span<const double> x(first.values.ptr<double>(), first.values.total());
    const std::span<const double> y(second.values.ptr<double>(), second.values.total());
    auto json = errorJson(x, y);
    const auto width = static_cast<std::size_t>(first.values.cols), height = static_cast<std::size_t>(first.values.rows);
    const auto similarity = stats::ssim({x, width, height}, {y, width, height}, *range);
    put(json, "ssim", similarity.mean.exists() ? similarity.mean : stats::Value::undefined(similarity.why));
    return json;
}

}  // namespace

ordered_json similarityOf(const std::filesystem::path& a, const std::filesystem::path& b, std::optional<double> range)
{
    if (isTrace(a) != isTrace(b))
        throw protocols::badInput({"a trace and an image cannot be compared", bothNames(a, b), "two traces or two images",
                                   "check the names of both files"});
    return isTrace(a) ? ofTraces(a, b) : ofImages(a, b, range);
}

}  // namespace study::analyse
