#include "study/bench/cost_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/orders/allocation.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "rendering/signals/shape_from_shading.h"
#include "rendering/signals/surface_integration.h"
#include "stats/kernels/distributions.h"
#include "stats/metrics/image_metrics.h"
#include "stats/power/simulated_study.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/t_tests.h"
#include "study/bench/bench_turns.h"
#include "study/bench/median_time.h"
#include "study/simulation/simulation_analysis.h"

namespace study::bench {

namespace {

using nlohmann::ordered_json;

cv::Mat noise(int side, int type, double high)
{
    cv::Mat values(side, side, type);
    cv::RNG(11).fill(values, cv::RNG::UNIFORM, 0, high);
    return values;
}

int sideOf(double pixels) { return static_cast<int>(std::lround(std::sqrt(pixels))); }

std::function<void()> integration(double pixels)
{
    const int side = sideOf(pixels);
    const rendering::signals::Slopes slopes{noise(side, CV_32FC1, 0.5), noise(side, CV_32FC1, 0.5)};
    return [slopes] {
        rendering::signals::integrate(slopes, {0.05, 0.05}, rendering::signals::SlopeKind::Point,
                                      rendering::signals::IntegrationQuality::Fast);
    };
}

std::function<void()> shading(double pixels)
{
    const cv::Mat photograph = noise(sideOf(pixels), CV_8UC1, 256);
    return [photograph] { rendering::signals::shapeFromShading(photograph); };
}

std::function<void()> similarity(double pixels)
{
    const int side = sideOf(pixels);
    const cv::Mat a = noise(side, CV_32FC1, 1), b = a * 0.9;
    return [a, b] {
        const auto view = [](const cv::Mat& image) {
            return stats::FloatImageView{std::span(image.ptr<float>(), image.total()), static_cast<std::size_t>(image.cols),
                                         static_cast<std::size_t>(image.rows)};
        };
        (void)stats::ssim(view(a), view(b), 1);
    };
}

std::function<void()> runningOrders(int fabrics, int conditions)
{
    protocols::Protocol protocol;
    protocol.participants = 10;
    protocol.fabricCount = fabrics;
    for (int c = 1; c <= conditions; ++c) protocol.conditions.emplace_back("c" + std::to_string(c));
    const protocols::Question choice{protocols::QuestionId("Q1"), "", protocols::ForcedChoice{}};
    protocol.phases.push_back({{choice}, choice.kind});
    return [protocol] { protocols::drawDesign(protocol, 1); };
}

/// Means by participant, the analysis of variance, Friedman's test and all paired t tests of a study of 7 fabrics and 9
/// conditions.
std::function<void()> participantTests(double participants)
{
    stats::StudyDesign design;
    design.participants = static_cast<std::size_t>(participants);
    const auto study = std::make_shared<stats::CrossedStudy>(stats::emptyStudy(design));
    stats::Draws draws(3, 0);
    stats::drawRatings(*study, {}, std::vector<double>(design.conditions, 0.0), draws);
    return [study, design] {
        const stats::BlockTable means = stats::participantMeans(*study);
        (void)stats::repeatedMeasuresAnova(means);
        (void)stats::friedmanTest(means);
        for (std::size_t a = 0; a < design.conditions; ++a)
            for (std::size_t b = a + 1; b < design.conditions; ++b) (void)stats::pairedTTest(means.column(a), means.column(b));
    };
}

/// The sessions of the paper's study in memory, with means, intervals and participant-level tests.
std::function<void()> simulatedParticipants(double participants)
{
    auto protocol = protocols::protocolFromJson(std::string(protocols::paperProtocolJson()), "bench");
    std::vector<protocols::FabricId> fabrics;
    players::Percepts percepts;
    for (int fabric = 1; fabric <= protocol.fabricCount; ++fabric) {
        fabrics.emplace_back("F" + std::to_string(fabric));
        percepts.fabrics[fabrics.back()].texture.at(static_cast<std::size_t>(fabric) % 3) = 0.2 * fabric;
    }
    const auto allocation =
        protocols::allocate(protocol, protocols::drawDesign(protocol, 1), fabrics, protocols::SecretKey::ofSeed(2));
    for (const auto& [code, entry] : allocation.key.entries) percepts.stimuli[code] = percepts.fabrics.at(entry.fabric);
    const auto study =
        std::make_shared<simulation::MemoryStudy>(simulation::memoryStudyOf(protocol, allocation, fabrics, std::move(percepts)));
    return [study, participants] {
        simulation::SimulationRequest request;
        request.count = static_cast<int>(participants);
        request.threads = 1;
        (void)simulation::analysisOf(*study, simulation::simulateInMemory(*study, request));
    };
}

const std::vector<double>& squares()
{
    static const std::vector<double> all{128 * 128, 256 * 256, 512 * 512, 1024 * 1024, 2048 * 2048, 4096 * 4096};
    return all;
}

const std::vector<double>& participantCounts()
{
    static const std::vector<double> all{10, 30, 100, 300, 1000, 3000, 10000};
    return all;
}

struct NamedCurve {
    const char* work;
    const char* sizeIs;
    bool isLinear;
    std::vector<double> sizes;
    WorkOfSize workOf;
};

const std::vector<NamedCurve>& allCurves()
{
    static const std::vector<NamedCurve> all{
        {"integration, 32 bits", "pixels", false, squares(), integration},
        {"shape from shading", "pixels", false, squares(), shading},
        {"SSIM, 32 bits", "pixels", true, squares(), similarity},
        {"running orders, 9 conditions",
         "fabrics",
         false,
         {7, 14, 28, 50, 100},
         [](double n) { return runningOrders(static_cast<int>(n), 9); }},
        {"running orders, 7 fabrics",
         "conditions",
         false,
         {9, 14, 20, 28, 40},
         [](double n) { return runningOrders(7, static_cast<int>(n)); }},
        {"participant-level tests", "participants", true, participantCounts(), participantTests},
        {"simulated study in memory", "participants", true, participantCounts(), simulatedParticipants}};
    return all;
}

std::string number(double value, const char* format)
{
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

constexpr const char* tooFewSizes = "an exponent needs two sizes, its interval three";

}  // namespace

void fitExponent(CostCurve& curve)
{
    const auto n = static_cast<double>(curve.points.size());
    if (n < 2) return;
    double meanX = 0, meanY = 0, xx = 0, xy = 0, residual = 0;
    for (const CostPoint& point : curve.points) {
        meanX += std::log(point.size) / n;
        meanY += std::log(point.milliseconds) / n;
    }
    for (const CostPoint& point : curve.points) {
        const double x = std::log(point.size) - meanX;
        xx += x * x;
        xy += x * (std::log(point.milliseconds) - meanY);
    }
    constexpr double leastSpread = 1e-12;  // sizes that differ by a millionth
    if (!(xx > leastSpread)) return;
    const double slope = xy / xx;
    curve.exponent = slope;
    if (n < 3) return;
    for (const CostPoint& point : curve.points)
        residual += std::pow(std::log(point.milliseconds) - meanY - slope * (std::log(point.size) - meanX), 2);
    const double half = stats::studentQuantile(0.025, n - 2) * std::sqrt(residual / (n - 2) / xx);
    curve.ci95 = Quartiles{slope - half, slope + half};
}

CostCurve measuredCurve(const std::string& work, const std::string& sizeIs, bool isLinear, const std::vector<double>& sizes,
                        const WorkOfSize& workOf, double wantedMs)
{
    constexpr std::size_t mostRuns = 101;
    CostCurve curve{work, sizeIs, isLinear, {}, {}, {}};
    for (const double size : sizes) {
        const auto timed = workOf(size);
        std::vector<double> times;
        const auto megabytes = megabytesOf([&] { times.push_back(millisecondsOf(timed)); });
        double spent = times.front();
        if (spent < wantedMs) {  // the first run of a short work warms the caches
            times.clear();
            spent = 0;
        }
        for (; times.size() < mostRuns && (times.empty() || spent < wantedMs); spent += times.back())
            times.push_back(millisecondsOf(timed));
        std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
        curve.points.push_back({size, times[times.size() / 2], megabytes});
    }
    fitExponent(curve);
    return curve;
}

std::size_t costCurveCount() { return allCurves().size(); }

std::vector<CostCurve> costCurves(const std::function<void(const std::string&)>& begins, const stats::Share& share)
{
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    std::vector<CostCurve> curves;
    for (std::size_t i = 0; i < share.sizeOf(allCurves().size()); ++i) {
        const NamedCurve& one = allCurves()[share.item(i)];
        if (begins) begins(std::string("cost curve: ") + one.work);
        curves.push_back(measuredCurve(one.work, one.sizeIs, one.isLinear, one.sizes, one.workOf));
    }
    cv::setNumThreads(threads);
    return curves;
}

ordered_json jsonOf(const CostCurve& curve)
{
    ordered_json json{{"work", curve.work}, {"size_is", curve.sizeIs}, {"linear", curve.isLinear}};
    json["exponent"] = curve.exponent ? ordered_json(*curve.exponent) : ordered_json();
    json["exponent_ci95"] = curve.ci95 ? ordered_json{curve.ci95->low, curve.ci95->high} : ordered_json();
    if (!curve.exponent) json["why"]["exponent"] = tooFewSizes;
    if (!curve.ci95) json["why"]["exponent_ci95"] = tooFewSizes;
    json["points"] = ordered_json::array();
    for (const CostPoint& point : curve.points) {
        json["points"].push_back({{"size", point.size}, {"ms", point.milliseconds}});
        json["points"].back()["mb"] = point.megabytes ? ordered_json(*point.megabytes) : ordered_json();
        if (!point.megabytes) json["points"].back()["why"] = {{"mb", "the memory of this size was not measured"}};
    }
    return json;
}

CostCurve curveFrom(const ordered_json& json, const std::string& where)
{
    try {
        CostCurve curve{
            json.at("work").get<std::string>(), json.at("size_is").get<std::string>(), json.at("linear").get<bool>(), {}, {}, {}};
        for (const ordered_json& point : json.at("points")) {
            const ordered_json& memory = point.at("mb");
            curve.points.push_back({point.at("size").get<double>(), point.at("ms").get<double>(),
                                    memory.is_null() ? std::optional<double>() : std::optional(memory.get<double>())});
            const double before = curve.points.size() > 1 ? curve.points[curve.points.size() - 2].size : 0;
            if (!(curve.points.back().size > before && curve.points.back().milliseconds > 0))
                throw ordered_json::other_error::create(501, "a size that does not grow, or no time", nullptr);
        }
        fitExponent(curve);
        return curve;
    } catch (const ordered_json::exception&) {
        throw protocols::badInput(
            {"a cost curve is damaged", where, "curves as `vis2hap bench curves` writes them", "run this shard again"});
    }
}

std::string tableOf(const std::vector<CostCurve>& curves)
{
    std::string text;
    for (const CostCurve& curve : curves) {
        const std::string sizeIs = protocols::printable(curve.sizeIs);  // both may come from another lab's shard
        text += protocols::printable(curve.work) + ": time ~ " + sizeIs + "^" +
                (curve.exponent ? number(*curve.exponent, "%.2f") : "?");
        if (curve.ci95)
            text += " (95 % interval " + number(curve.ci95->low, "%.2f") + " to " + number(curve.ci95->high, "%.2f") + ")";
        if (curve.isLinear) text += "; linear work, promised at most 1.05";
        text += "\n";
        for (const CostPoint& point : curve.points)
            text += "  " + number(point.size, "%10.0f") + " " + sizeIs + number(point.milliseconds, "%14.3f ms") +
                    (point.megabytes ? number(*point.megabytes, "%10.1f MB") : "") + "\n";
    }
    return text;
}

}  // namespace study::bench
