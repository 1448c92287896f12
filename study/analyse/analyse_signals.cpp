#include "study/analyse/analyse_signals.h"

#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>

#include "protocols/files/errors.h"
#include "rendering/images/image_io.h"
#include "stats/metrics/image_metrics.h"
#include "stats/metrics/registered_ssim.h"
#include "stats/metrics/spectrum_distance.h"
#include "stats/metrics/trace_error.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"
#include "study/analyse/analyse_recipe.h"

namespace study::analyse {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double mostSpectrumWork = 2e9;  // values x segment: some seconds
constexpr double mostShiftWork = 2e9;     // pixels x shifts: some seconds

ordered_json traceError(const AnalysisRequest& request)
{
    const auto e = stats::traceError(numbersAt(request.inputs, "generated"), numbersAt(request.inputs, "truth"));
    if (!e.why.empty()) return degenerate(e.why);
    AnswerFields answer;
    answer.put("mae", e.mae).put("mean_truth", e.meanTruth).put("mae_over_mean", e.maeOverMean);
    return answer.put("rmse", e.rmse).put("bias", e.bias).put("max_abs", e.maxAbs).json();
}

ordered_json spectrumDistance(const AnalysisRequest& request)
{
    const long long segment = wholeOr(request.options, "segment", 64);
    if (segment < 4 || segment > 65536) throw RequestFault("segment must lie between 4 and 65536 values");
    const auto generated = numbersAt(request.inputs, "generated"), truth = numbersAt(request.inputs, "truth");
    checkSize("values x segment", static_cast<double>(generated.size() + truth.size()) * static_cast<double>(segment),
              mostSpectrumWork);
    const auto d = stats::spectrumDistance(generated, truth, static_cast<std::size_t>(segment));
    if (!d.why.empty()) return degenerate(d.why);
    return AnswerFields().put("decibels", d.decibels).put("bias_decibels", d.bias).putCount("frequencies", d.frequencies).json();
}

struct NumberImage {
    std::vector<double> pixels;
    std::size_t width = 0;
    std::size_t height = 0;

    stats::ImageView view() const { return {pixels, width, height}; }
};

NumberImage imageOfArray(const std::filesystem::path& file)
{
    cv::Mat stored;
    try {
        stored = rendering::readNpy(file);
    } catch (const protocols::Error& fault) {
        throw RequestFault(fault.what());
    }
    if (stored.channels() != 1)
        throw RequestFault(file.string() + " has " + std::to_string(stored.channels()) + " channels; expected 1");
    cv::Mat numbers;
    stored.convertTo(numbers, CV_64F);
    NumberImage image{{}, static_cast<std::size_t>(numbers.cols), static_cast<std::size_t>(numbers.rows)};
    for (int row = 0; row < numbers.rows; ++row)
        image.pixels.insert(image.pixels.end(), numbers.ptr<double>(row), numbers.ptr<double>(row) + numbers.cols);
    return image;
}

NumberImage imageOfRows(const json& inputs, const std::string& field)
{
    NumberImage image;
    for (const auto& row : rowsAt(inputs, field)) {
        if (image.height > 0 && row.size() != image.width) throw RequestFault("the rows of " + field + " differ in length");
        image.width = row.size();
        ++image.height;
        image.pixels.insert(image.pixels.end(), row.begin(), row.end());
    }
    return image;
}

/// Both images from one recipe, which states their shape.
std::pair<NumberImage, NumberImage> imagesOfRecipe(const json& inputs)
{
    if (!inputs.at("recipe").is_string()) throw RequestFault("the recipe is not a string");
    RecipeArrays made = arraysOfRecipe(inputs.at("recipe").get<std::string>(), constantsIn(inputs));
    if (made.arrays.count("a") == 0 || made.arrays.count("b") == 0)
        throw RequestFault("the recipe does not define the images a and b");
    if (made.rows == 0) throw RequestFault("the recipe states no shape; expected for instance \"800 rows x 1280 cols\"");
    return {NumberImage{std::move(made.arrays["a"]), made.columns, made.rows},
            NumberImage{std::move(made.arrays["b"]), made.columns, made.rows}};
}

NumberImage imageOf(const AnalysisRequest& request, const std::string& field)
{
    if (!request.inputs.contains(field)) throw RequestFault("the inputs have no " + field);
    if (request.inputs[field].is_string()) return imageOfArray(request.folder / request.inputs[field].get<std::string>());
    return imageOfRows(request.inputs, field);
}

std::pair<NumberImage, NumberImage> imagesOf(const AnalysisRequest& request)
{
    if (request.inputs.contains("recipe")) return imagesOfRecipe(request.inputs);
    return {imageOf(request, "a"), imageOf(request, "b")};
}

stats::SsimOptions ssimOptionsOf(const AnalysisRequest& request)
{
    constexpr NamedChoice<stats::SsimWindow> windows[] = {{"gaussian 11x11 sigma 1.5", stats::SsimWindow::Gaussian11},
                                                          {"uniform 7x7", stats::SsimWindow::Uniform7}};
    constexpr NamedChoice<bool> moments[] = {{"population", false}, {"sample", true}};
    if (const std::string region = textOr(request.options, "region", "valid"); region != "valid")
        throw RequestFault("unknown region \"" + region + "\"; expected: valid");
    return {choiceOr(request.options, "window", windows, "gaussian 11x11 sigma 1.5"),
            choiceOr(request.options, "covariance", moments, "population"), numberOr(request.options, "K1", 0.01),
            numberOr(request.options, "K2", 0.03)};
}

ordered_json ssim(const AnalysisRequest& request)
{
    const auto [a, b] = imagesOf(request);
    const double range = numberAt(request.options, "data_range");
    const stats::SsimOptions options = ssimOptionsOf(request);
    const auto similarity = stats::ssim(a.view(), b.view(), range, options);
    if (!similarity.why.empty()) return degenerate(similarity.why);
    const auto box = stats::ssim(a.view(), b.view(), range, {stats::SsimWindow::Uniform7, true, options.k1, options.k2});
    const auto error = stats::traceError(a.pixels, b.pixels);
    AnswerFields answer;
    answer.put("ssim", similarity.mean).put("map_min", similarity.smallest).put("map_max", similarity.largest);
    answer.putText("map_shape", {similarity.windowsDown, similarity.windowsAcross}).put("ssim_uniform7_sample_cov", box.mean);
    return answer.put("mae", error.mae).put("rmse", error.rmse).json();
}

ordered_json registeredSsim(const AnalysisRequest& request)
{
    const auto [a, b] = imagesOf(request);
    const long long most = wholeOr(request.options, "most_shift", 8);
    if (most < 0 || most > 1000) throw RequestFault("most_shift must lie between 0 and 1000 pixels");
    const auto shifts = static_cast<double>(2 * most + 1);
    checkSize("pixels x shifts", static_cast<double>(a.pixels.size()) * shifts * shifts, mostShiftWork);
    const auto r = stats::registeredSsim(a.view(), b.view(), numberAt(request.options, "data_range"), static_cast<int>(most),
                                         ssimOptionsOf(request));
    if (!r.why.empty()) return degenerate(r.why);
    AnswerFields answer;
    answer.put("ssim", r.ssim).putText("right", r.right).putText("down", r.down);
    return answer.put("correlation", r.correlation).put("ssim_unregistered", r.ssimUnregistered).json();
}

}  // namespace

std::vector<NamedAnalysis> analysesOfSignals()
{
    return {
        {"trace_error", traceError, "generated truth", "", "errors of a generated trace"},
        {"spectrum_distance", spectrumDistance, "generated truth", "[segment]", "distance of power spectra in decibels"},
        {"ssim", ssim, "a b [dtype] [shape]", "data_range [window] [K1] [K2] [covariance] [region]", "SSIM, MAE and RMSE"},
        {"registered_ssim", registeredSsim, "a b [dtype] [shape]",
         "data_range [most_shift] [window] [K1] [K2] [covariance] [region]", "SSIM at the shift of best correlation"},
    };
}

}  // namespace study::analyse
