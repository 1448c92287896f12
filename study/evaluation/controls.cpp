#include "study/evaluation/controls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <set>

#include "protocols/random.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/photograph_features.h"
#include "stats/kernels/threads.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;

constexpr Modality tactile = Modality::Tactile, friction = Modality::Friction, visual = Modality::Visual;

/// Features and mean of one training sample.
struct SampleFeatures {
    std::size_t fabric = 0;
    FeatureVector features;
    double mean = 0;
};

std::vector<std::pair<std::size_t, PlannedSample>> trainingSamples(const TestPlan& plan, Modality modality)
{
    std::vector<std::pair<std::size_t, PlannedSample>> samples;
    for (std::size_t i = 0; i < plan.fabrics.size(); ++i)
        if (const auto found = plan.fabrics[i].training.find(modality); found != plan.fabrics[i].training.end())
            for (const PlannedSample& sample : found->second) samples.emplace_back(i, sample);
    return samples;
}

/// At most maxPressesPerFabric presses of each fabric, drawn by seed.
std::vector<std::pair<std::size_t, PlannedSample>> drawnPresses(const TestPlan& plan, const PlanRequest& request)
{
    auto samples = trainingSamples(plan, tactile);
    protocols::Random random = protocols::Random::stream(request.seed, "evaluate/training presses");
    random.shuffle(samples);
    std::vector<std::size_t> taken(plan.fabrics.size());
    std::erase_if(samples, [&](const auto& entry) { return ++taken[entry.first] > maxPressesPerFabric; });
    return samples;
}

template <class FeaturesOfSample>
std::vector<SampleFeatures> computeFeatures(const std::vector<std::pair<std::size_t, PlannedSample>>& samples, unsigned threads,
                                            const std::string& stage, const Report& report,
                                            const FeaturesOfSample& featuresOfSample)
{
    std::vector<SampleFeatures> computed(samples.size());
    stats::onThreads(
        samples.size(), threads,
        [&](std::size_t i) {
            computed[i] = featuresOfSample(samples[i].second);
            computed[i].fabric = samples[i].first;
        },
        [&](std::size_t done) {
            if (report) report(stage, static_cast<int>(done), static_cast<int>(samples.size()));
        });
    return computed;
}

using FeaturesByFabric = std::vector<std::vector<FeatureVector>>;

FeaturesByFabric byFabric(const std::vector<SampleFeatures>& samples, std::size_t fabricCount)
{
    FeaturesByFabric result(fabricCount);
    for (const SampleFeatures& one : samples) result[one.fabric].push_back(one.features);
    return result;
}

/// Joins the k-th press and the k-th stroke of a fabric; any press and any stroke of a fabric belong together.
FeaturesByFabric pairedFeatures(const FeaturesByFabric& heights, const FeaturesByFabric& frictions)
{
    FeaturesByFabric result(heights.size());
    for (std::size_t k = 0; k < heights.size(); ++k)
        for (std::size_t i = 0; i < std::min(heights[k].size(), frictions[k].size()); ++i) {
            result[k].push_back(heights[k][i]);
            result[k].back().insert(result[k].back().end(), frictions[k][i].begin(), frictions[k][i].end());
        }
    return result;
}

/// Computes the mean of every fabric that is not held out, and the mean over these fabrics.
void setMeans(const TestPlan& plan, const std::vector<SampleFeatures>& samples, const std::string& what, stats::Value& over,
              std::vector<stats::Value>& ofFabric)
{
    double sum = 0;
    int fabricCount = 0;
    for (std::size_t i = 0; i < plan.fabrics.size(); ++i) {
        double total = 0;
        int count = 0;
        for (const SampleFeatures& one : samples)
            if (one.fabric == i) {
                total += one.mean;
                ++count;
            }
        if (plan.fabrics[i].heldOut)
            ofFabric.push_back(stats::Value::undefined("the fabric is held out, so its samples must not be used"));
        else if (count == 0)
            ofFabric.push_back(stats::Value::undefined("the training part has no " + what + " of the fabric"));
        else
            ofFabric.push_back(total / count);
        if (ofFabric.back().exists()) {
            sum += *ofFabric.back();
            ++fabricCount;
        }
    }
    over = fabricCount > 0 ? stats::Value(sum / fabricCount) : stats::Value::undefined("the training part has no " + what);
}

/// Side of the square, px, from which features of generated and measured maps are computed. One photograph stands for all of its
/// pitch.
int commonSide(const fabrics::Dataset& dataset, const MeasuredSignals& measured, const TestPlan& plan)
{
    int side = std::numeric_limits<int>::max();
    for (const TestPair& pair : plan.pairs)
        if (pair.press) {
            const cv::Mat height = measured.height(pair.press->fabric, pair.press->index);
            side = std::min(height.cols, height.rows);
            break;
        }
    const fabrics::PhotographViews views(dataset);
    const double pitch = measured.pitchMm();
    std::set<double> pitches;
    for (const TestPair& pair : plan.pairs) {
        const PlannedSample& tested = pair.photograph;
        const double own = views.mmPerPixel(tested.fabric, tested.index).value_or(pitch);
        if (!pitches.insert(own).second) continue;
        const cv::Mat photograph = fabrics::readPhotograph(dataset, tested.fabric, tested.index);
        side = std::min(side, static_cast<int>(std::lround(std::min(photograph.cols, photograph.rows) * (own / pitch))));
    }
    return side;
}

double squaredDistance(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
    return sum;
}

std::vector<std::vector<float>> photographFeaturesOf(const fabrics::Dataset& dataset,
                                                     const std::vector<PlannedSample>& photographs, unsigned threads,
                                                     const Report& report)
{
    std::vector<std::vector<float>> features(photographs.size());
    stats::onThreads(
        photographs.size(), threads,
        [&](std::size_t i) {
            features[i] = rendering::models::photographFeatures(
                fabrics::readPhotograph(dataset, photographs[i].fabric, photographs[i].index));
        },
        [&](std::size_t done) {
            if (report)
                report("training photographs for retrieval", static_cast<int>(done), static_cast<int>(photographs.size()));
        });
    return features;
}

/// A training sample of the retrieved photograph's fabric.
std::optional<PlannedSample> partnerOf(const TestPlan& plan, std::size_t fabric, const PlannedSample& photograph,
                                       Modality modality, bool aligned, protocols::Random& random)
{
    const auto found = plan.fabrics[fabric].training.find(modality);
    if (found == plan.fabrics[fabric].training.end() || found->second.empty()) return {};
    if (!aligned) return found->second[random.below(found->second.size())];
    for (const PlannedSample& sample : found->second)
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
        controls.whyNoRetrieval = "the training part has no photograph to retrieve";
        return;
    }
    std::vector<PlannedSample> photographs;
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
        const PlannedSample& tested = plan.pairs[i].photograph;
        protocols::Random random = protocols::Random::stream(
            request.seed, "evaluate/retrieved/" + tested.fabric.value + "/" + std::to_string(tested.index));
        const bool aligned = dataset.pairing == fabrics::Pairing::Aligned;
        RetrievedSamples retrieved{photograph, {}, {}};
        retrieved.press = partnerOf(plan, fabric, photograph, tactile, aligned, random);
        retrieved.stroke = partnerOf(plan, fabric, photograph, friction, aligned, random);
        controls.retrieved.push_back(std::move(retrieved));
    }
}

}  // namespace

Controls fitControls(const fabrics::Dataset& dataset, const MeasuredSignals& measured, const TestPlan& plan,
                     const PlanRequest& request, const Report& report)
{
    Controls controls;
    std::vector<SampleFeatures> heights, frictions;
    const double pitch = measured.pitchMm();
    if (measured.whyNoHeight().empty()) {
        const int side = commonSide(dataset, measured, plan);
        controls.featureSide = side;
        heights =
            computeFeatures(drawnPresses(plan, request), request.threads, "presses of the training part", report,
                            [&](const PlannedSample& sample) {
                                const HeightMap map{measured.height(sample.fabric, sample.index), pitch, 0};
                                return SampleFeatures{0, featureVector(heightFeatures(map, side)), cv::mean(map.heightMm)[0]};
                            });
    }
    if (measured.whyNoFriction().empty())
        frictions = computeFeatures(
            trainingSamples(plan, friction), request.threads, "strokes of the training part", report,
            [&](const PlannedSample& sample) {
                const auto trace = measured.trace(sample.fabric, sample.index);
                return SampleFeatures{0, featureVector(frictionFeatures({trace.values, trace.mmPerSample})), trace.mean};
            });
    controls.presses = static_cast<int>(heights.size());
    controls.strokes = static_cast<int>(frictions.size());
    setMeans(plan, heights, "press", controls.heightMm, controls.heightMmOfFabric);
    setMeans(plan, frictions, "stroke", controls.friction, controls.frictionOfFabric);
    const auto ofHeight = byFabric(heights, plan.fabrics.size()), ofFriction = byFabric(frictions, plan.fabrics.size());
    controls.identifiers.reset(
        new Identifiers{Identifier(ofHeight), Identifier(ofFriction), Identifier(pairedFeatures(ofHeight, ofFriction))});
    retrieve(dataset, plan, request, report, controls);
    return controls;
}

}  // namespace study::evaluation
