#include "study/evaluation/controls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "rendering/models/photograph_features.h"
#include "stats/kernels/threads.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;

constexpr Modality tactile = Modality::Tactile, friction = Modality::Friction, visual = Modality::Visual;

struct Heard {
    std::size_t fabric = 0;
    FeatureVector features;
    double mean = 0;
};

std::vector<std::pair<std::size_t, Sample>> trainingSamples(const TestPlan& plan, Modality modality)
{
    std::vector<std::pair<std::size_t, Sample>> samples;
    for (std::size_t i = 0; i < plan.fabrics.size(); ++i)
        if (const auto found = plan.fabrics[i].training.find(modality); found != plan.fabrics[i].training.end())
            for (const Sample& sample : found->second) samples.emplace_back(i, sample);
    return samples;
}

/// At most mostPressesOfFabric of each fabric.
std::vector<std::pair<std::size_t, Sample>> drawnPresses(const TestPlan& plan, const PlanRequest& request)
{
    auto samples = trainingSamples(plan, tactile);
    protocols::Random random = protocols::Random::stream(request.seed, "evaluate/training presses");
    random.shuffle(samples);
    std::vector<std::size_t> taken(plan.fabrics.size());
    std::erase_if(samples, [&](const auto& entry) { return ++taken[entry.first] > mostPressesOfFabric; });
    return samples;
}

template <class Hear>
std::vector<Heard> hear(const std::vector<std::pair<std::size_t, Sample>>& samples, unsigned threads, const std::string& stage,
                        const Report& report, const Hear& one)
{
    std::vector<Heard> heard(samples.size());
    stats::onThreads(
        samples.size(), threads,
        [&](std::size_t i) {
            heard[i] = one(samples[i].second);
            heard[i].fabric = samples[i].first;
        },
        [&](std::size_t done) {
            if (report) report(stage, static_cast<int>(done), static_cast<int>(samples.size()));
        });
    return heard;
}

using OfClass = std::vector<std::vector<FeatureVector>>;

OfClass byFabric(const std::vector<Heard>& heard, std::size_t fabricCount)
{
    OfClass result(fabricCount);
    for (const Heard& one : heard) result[one.fabric].push_back(one.features);
    return result;
}

/// The k-th press beside the k-th stroke: any press and any stroke of a fabric belong together.
OfClass sideBySide(const OfClass& heights, const OfClass& frictions)
{
    OfClass result(heights.size());
    for (std::size_t k = 0; k < heights.size(); ++k)
        for (std::size_t i = 0; i < std::min(heights[k].size(), frictions[k].size()); ++i) {
            result[k].push_back(heights[k][i]);
            result[k].back().insert(result[k].back().end(), frictions[k][i].begin(), frictions[k][i].end());
        }
    return result;
}

/// Of every fabric that is not held out, and over them.
void setMeans(const TestPlan& plan, const std::vector<Heard>& heard, const std::string& what, stats::Value& over,
              std::vector<stats::Value>& ofFabric)
{
    double sum = 0;
    int fabricCount = 0;
    for (std::size_t i = 0; i < plan.fabrics.size(); ++i) {
        double total = 0;
        int count = 0;
        for (const Heard& one : heard)
            if (one.fabric == i) {
                total += one.mean;
                ++count;
            }
        if (plan.fabrics[i].heldOut)
            ofFabric.push_back(stats::Value::undefined("the fabric is held out: nothing of it may be known"));
        else if (count == 0)
            ofFabric.push_back(stats::Value::undefined("the training part holds no " + what + " of the fabric"));
        else
            ofFabric.push_back(total / count);
        if (ofFabric.back().exists()) {
            sum += *ofFabric.back();
            ++fabricCount;
        }
    }
    over = fabricCount > 0 ? stats::Value(sum / fabricCount) : stats::Value::undefined("the training part holds no " + what);
}

/// The side of the square in which generated and measured maps are described alike.
int commonSide(const fabrics::Dataset& dataset, const MeasuredSignals& measured, const TestPlan& plan)
{
    int side = std::numeric_limits<int>::max();
    for (const TestPair& pair : plan.pairs)
        if (pair.press) {
            const cv::Mat height = measured.height(pair.press->fabric, pair.press->index);
            side = std::min(height.cols, height.rows);
            break;
        }
    const Sample& first = plan.pairs.front().photograph;
    const cv::Mat photograph = fabrics::readPhotograph(dataset, first.fabric, first.index);
    const double pitch = measured.pitchMm(), ratio = dataset.cameraMmPerPixel.value_or(pitch) / pitch;
    return std::min(side, static_cast<int>(std::lround(std::min(photograph.cols, photograph.rows) * ratio)));
}

double squaredDistance(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
    return sum;
}

std::vector<std::vector<float>> photographFeaturesOf(const fabrics::Dataset& dataset, const std::vector<Sample>& photographs,
                                                     unsigned threads, const Report& report)
{
    std::vector<std::vector<float>> features(photographs.size());
    stats::onThreads(
        photographs.size(), threads,
        [&](std::size_t i) {
            features[i] = rendering::models::photographFeatures(
                fabrics::readPhotograph(dataset, photographs[i].fabric, photographs[i].index));
        },
        [&](std::size_t done) {
            if (report) report("photographs to retrieve from", static_cast<int>(done), static_cast<int>(photographs.size()));
        });
    return features;
}

/// A training sample of the retrieved photograph's fabric.
std::optional<Sample> partnerOf(const TestPlan& plan, std::size_t fabric, const Sample& photograph, Modality modality,
                                bool aligned, protocols::Random& random)
{
    const auto found = plan.fabrics[fabric].training.find(modality);
    if (found == plan.fabrics[fabric].training.end() || found->second.empty()) return {};
    if (!aligned) return found->second[random.below(found->second.size())];
    for (const Sample& sample : found->second)
        if (sample.index == photograph.index) return sample;
    return {};
}

void retrieve(const fabrics::Dataset& dataset, const TestPlan& plan, const PlanRequest& request, const Report& report,
              Controls& controls)
{
    auto known = trainingSamples(plan, visual);
    std::erase_if(known, [&](const auto& entry) { return plan.fabrics[entry.first].heldOut; });
    controls.photographs = static_cast<int>(known.size());
    if (known.empty()) {
        controls.whyNothingRetrieved = "the training part holds no photograph to retrieve";
        return;
    }
    std::vector<Sample> photographs;
    for (const auto& entry : known) photographs.push_back(entry.second);
    for (const TestPair& pair : plan.pairs) photographs.push_back(pair.photograph);
    const auto features = photographFeaturesOf(dataset, photographs, request.threads, report);
    for (std::size_t i = 0; i < plan.pairs.size(); ++i) {
        std::size_t nearest = 0;
        for (std::size_t k = 1; k < known.size(); ++k)
            if (squaredDistance(features[k], features[known.size() + i]) <
                squaredDistance(features[nearest], features[known.size() + i]))
                nearest = k;
        const auto& [fabric, photograph] = known[nearest];
        const Sample& asked = plan.pairs[i].photograph;
        protocols::Random random = protocols::Random::stream(
            request.seed, "evaluate/retrieved/" + asked.fabric.value + "/" + std::to_string(asked.index));
        const bool aligned = dataset.pairing == fabrics::Pairing::Aligned;
        Retrieved retrieved{photograph, {}, {}};
        retrieved.press = partnerOf(plan, fabric, photograph, tactile, aligned, random);
        retrieved.stroke = partnerOf(plan, fabric, photograph, friction, aligned, random);
        controls.retrieved.push_back(std::move(retrieved));
    }
}

}  // namespace

Controls learnControls(const fabrics::Dataset& dataset, const MeasuredSignals& measured, const TestPlan& plan,
                       const PlanRequest& request, const Report& report)
{
    Controls controls;
    std::vector<Heard> heights, frictions;
    const double pitch = measured.pitchMm();
    if (measured.whyNoHeight().empty()) {
        const int side = commonSide(dataset, measured, plan);
        controls.featureSide = side;
        heights =
            hear(drawnPresses(plan, request), request.threads, "presses of the training part", report, [&](const Sample& sample) {
                const HeightMap map{measured.height(sample.fabric, sample.index), pitch, 0};
                return Heard{0, featureVector(heightFeatures(map, side)), cv::mean(map.heightMm)[0]};
            });
    }
    if (measured.whyNoFriction().empty())
        frictions = hear(trainingSamples(plan, friction), request.threads, "strokes of the training part", report,
                         [&](const Sample& sample) {
                             const auto trace = measured.trace(sample.fabric, sample.index);
                             return Heard{0, featureVector(frictionFeatures({trace.values, trace.mmPerSample})), trace.mean};
                         });
    controls.presses = static_cast<int>(heights.size());
    controls.strokes = static_cast<int>(frictions.size());
    setMeans(plan, heights, "press", controls.heightMm, controls.heightMmOfFabric);
    setMeans(plan, frictions, "stroke", controls.friction, controls.frictionOfFabric);
    const auto ofHeight = byFabric(heights, plan.fabrics.size()), ofFriction = byFabric(frictions, plan.fabrics.size());
    controls.judge.reset(new Judge{Identifier(ofHeight), Identifier(ofFriction), Identifier(sideBySide(ofHeight, ofFriction))});
    retrieve(dataset, plan, request, report, controls);
    return controls;
}

}  // namespace study::evaluation
