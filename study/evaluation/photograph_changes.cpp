#include "study/evaluation/photograph_changes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/fabrics/drawn/jpeg_loss.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/model_card_fields.h"
#include "study/evaluation/pixel_ridge.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;
using protocols::fixed;

double toLinear(double stored) { return std::pow(stored / 255, 2.2); }
double toStored(double linear) { return 255 * std::pow(std::clamp(linear, 0.0, 1.0), 1 / 2.2); }

/// Changes linear light, channel by channel and pixel by pixel.
cv::Mat withLight(const cv::Mat& rgb, const std::function<double(int row, int column, int channel)>& factor)
{
    cv::Mat result(rgb.size(), CV_8UC3);
    for (int row = 0; row < rgb.rows; ++row)
        for (int column = 0; column < rgb.cols; ++column)
            for (int channel = 0; channel < 3; ++channel)
                result.at<cv::Vec3b>(row, column)[channel] = cv::saturate_cast<uchar>(
                    toStored(toLinear(rgb.at<cv::Vec3b>(row, column)[channel]) * factor(row, column, channel)));
    return result;
}

/// The same brightness at each place, with the share of light that a dye reflects.
cv::Mat dyed(const cv::Mat& rgb, const cv::Vec3d& reflected)
{
    cv::Mat grey, alike;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    cv::cvtColor(grey, alike, cv::COLOR_GRAY2RGB);
    return withLight(alike, [&](int, int, int channel) { return reflected[channel]; });
}

cv::Mat dyedRed(const cv::Mat& rgb) { return dyed(rgb, {0.75, 0.12, 0.12}); }
cv::Mat dyedNavy(const cv::Mat& rgb) { return dyed(rgb, {0.10, 0.14, 0.35}); }

cv::Mat blurred(const cv::Mat& rgb)
{
    cv::Mat result;
    cv::GaussianBlur(rgb, result, {}, 1);
    return result;
}

cv::Mat halfExposed(const cv::Mat& rgb)
{
    return withLight(rgb, [](int, int, int) { return 0.5; });
}

cv::Mat noisy(const cv::Mat& rgb)
{
    cv::Mat noise(rgb.size(), CV_16SC3), sum;
    cv::RNG random(20);
    random.fill(noise, cv::RNG::NORMAL, 0, 8);
    cv::add(rgb, noise, sum, cv::noArray(), CV_8UC3);
    return sum;
}

cv::Mat withGamma(const cv::Mat& rgb)
{
    cv::Mat table(1, 256, CV_8U), result;
    for (int i = 0; i < 256; ++i) table.at<uchar>(i) = cv::saturate_cast<uchar>(255 * std::pow(i / 255.0, 1.4));
    cv::LUT(rgb, table, result);
    return result;
}

/// From 1.3 times the light at the upper left to half of it at the lower right.
cv::Mat unevenlyLit(const cv::Mat& rgb)
{
    return withLight(
        rgb, [&](int row, int column, int) { return 1.3 - 0.8 * (row + column) / std::max(1.0, rgb.rows + rgb.cols - 2.0); });
}

cv::Mat compressed(const cv::Mat& rgb) { return fabrics::afterJpeg(rgb, 50); }
cv::Mat grey(const cv::Mat& rgb) { return dyed(rgb, {1, 1, 1}); }

/// The photographs that are changed.
std::vector<models::InputPhotograph> photographsOf(const fabrics::Dataset& dataset, int mostOfAFabric)
{
    const fabrics::PhotographViews views(dataset);
    std::vector<models::InputPhotograph> photographs;
    for (const auto& fabric : dataset.fabrics) {
        const auto indices = fabrics::sampleIndices(dataset, fabric.id, Modality::Visual);
        for (std::size_t i = 0; i < indices.size() && static_cast<int>(i) < mostOfAFabric; ++i)
            photographs.push_back({fabrics::readPhotograph(dataset, fabric.id, indices[i]),
                                   views.mmPerPixel(fabric.id, indices[i]), views.lightDeg(fabric.id, indices[i]), fabric.fibre});
    }
    if (photographs.empty())
        throw protocols::badInput({"the data set has no photographs to change", dataset.folder.string(),
                                   "visual/*.png of at least one fabric", "import photographs with `vis2hap import photos`"});
    return photographs;
}

ChangeRow compared(const std::string& name, const std::vector<models::GeneratedSignals>& unchanged,
                   const std::vector<models::GeneratedSignals>& changed)
{
    ChangeRow row{name, 0, 0, 0, 1, std::nullopt};
    const double share = 1.0 / static_cast<double>(unchanged.size());
    for (std::size_t i = 0; i < unchanged.size(); ++i) {
        const double friction = std::abs(changed[i].meanFriction / unchanged[i].meanFriction - 1);
        const double correlation = reliefCorrelation(changed[i].heightMm, unchanged[i].heightMm);
        row.friction += share * friction;
        row.correlation += share * correlation;
        row.worstFriction = std::max(row.worstFriction, friction);
        row.worstCorrelation = std::min(row.worstCorrelation, correlation);
        if (const auto& interval = changed[i].photograph.meanFriction)
            row.covered = row.covered.value_or(0) +
                          (interval->low <= unchanged[i].meanFriction && unchanged[i].meanFriction <= interval->high ? share : 0);
    }
    return row;
}

}  // namespace

const std::vector<PhotographChange>& photographChanges()
{
    static const std::vector<PhotographChange> changes{
        {"dyed red", dyedRed},          {"dyed navy", dyedNavy},          {"blurred by 1 px", blurred},
        {"half exposure", halfExposed}, {"noise of 8 levels", noisy},     {"gamma 1.4", withGamma},
        {"uneven lamp", unevenlyLit},   {"JPEG, quality 50", compressed}, {"grey", grey}};
    return changes;
}

ChangeReport evaluateChanges(const fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report,
                             const Generate& generate)
{
    models::GenerationOptions options;
    options.model = request.model.empty() ? models::shippedModel() : request.model;
    options.quality = request.quality;
    std::vector<models::InputPhotograph> photographs = photographsOf(dataset, request.samplesPerFabric.value_or(1));
    // The scale stays what it was, also where it is only assumed.
    const auto unchanged = generate(photographs, options);
    for (std::size_t i = 0; i < photographs.size(); ++i)
        if (!photographs[i].mmPerPixel) photographs[i].mmPerPixel = unchanged[i].photograph.assumedMmPerPixel;
    ChangeReport changes{
        dataset.name, models::readModelCardFields(options.model).summary.name, static_cast<int>(photographs.size()), {}};
    for (const PhotographChange& change : photographChanges()) {
        std::vector<models::InputPhotograph> changed = photographs;
        for (models::InputPhotograph& one : changed) one.photograph = change.of(one.photograph);
        changes.rows.push_back(compared(change.name, unchanged, generate(changed, options)));
        if (report)
            report("changed photographs", static_cast<int>(changes.rows.size()), static_cast<int>(photographChanges().size()));
    }
    return changes;
}

nlohmann::ordered_json changesJson(const ChangeReport& changes)
{
    auto rows = nlohmann::ordered_json::array();
    for (const ChangeRow& row : changes.rows) {
        rows.push_back({{"change", row.name},
                        {"mean_friction_change", row.friction},
                        {"mean_friction_change_worst", row.worstFriction},
                        {"relief_correlation", row.correlation},
                        {"relief_correlation_worst", row.worstCorrelation}});
        rows.back()["interval_90_covers"] = row.covered ? nlohmann::ordered_json(*row.covered) : nlohmann::ordered_json();
        if (!row.covered) rows.back()["why"] = {{"interval_90_covers", "the model gives no interval of its mean friction"}};
    }
    return {{"schema", "vis2hap.evaluation/1"},
            {"dataset", changes.dataset},
            {"model", changes.model},
            {"photographs", changes.photographs},
            {"changes", rows}};
}

std::string changesText(const ChangeReport& changes)
{
    const auto column = [](const std::string& text, std::size_t width) {
        return std::string(width - std::min(width, text.size()), ' ') + text;
    };
    std::string text =
        "Changed photographs of the same cloth: model \"" + changes.model + "\", " + std::to_string(changes.photographs) +
        " photographs of \"" + changes.dataset +
        "\"\n  friction: change of the mean, mean and worst; relief: correlation with that of the unchanged photograph, "
        "mean and worst\n"
        "  interval: share of the 90 % intervals that hold the friction of the unchanged photograph\n";
    int met = 0;
    for (const ChangeRow& row : changes.rows) {
        met += row.met() ? 1 : 0;
        text += "  " + row.name + std::string(20 - std::min<std::size_t>(20, row.name.size()), ' ') + "friction" +
                column(fixed(100 * row.friction, 1) + " %", 8) + column(fixed(100 * row.worstFriction, 1) + " %", 9) +
                "   relief" + column(fixed(row.correlation, 3), 7) + column(fixed(row.worstCorrelation, 3), 7) +
                (row.covered ? "   interval" + column(fixed(100 * *row.covered, 0) + " %", 6) : "") +
                (row.met() ? "" : "  TOO MUCH") + "\n";
    }
    return text + "  friction within " + fixed(100 * ChangeRow::mostFrictionChange, 0) + " % and relief above " +
           fixed(ChangeRow::leastCorrelation, 1) + " on the mean: " + std::to_string(met) + " of " +
           std::to_string(changes.rows.size()) + " changes\n";
}

}  // namespace study::evaluation
