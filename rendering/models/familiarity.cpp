#include "rendering/models/familiarity.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "rendering/models/photograph_features.h"
#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

namespace {

/// A feature that hardly varies in training must not make every other photograph appear unfamiliar.
constexpr double leastFeatureDeviation = 0.02;
/// Without it, a single fabric with a few photographs would have a threshold of nearly 0.
constexpr double leastThreshold = 1;

using Standardised = std::vector<double>;

double fourDigits(double value)
{
    char text[32];
    const auto written = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
    double rounded = value;
    std::from_chars(text, written.ptr, rounded);
    return rounded;
}

std::vector<double> rounded(std::vector<double> numbers)
{
    std::transform(numbers.begin(), numbers.end(), numbers.begin(), fourDigits);
    return numbers;
}

double squaredDistance(const Standardised& a, const Standardised& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

double distanceToNearest(const std::vector<Standardised>& kept, const Standardised& point)
{
    double least = std::numeric_limits<double>::max();
    for (const Standardised& one : kept) least = std::min(least, squaredDistance(one, point));
    return std::sqrt(least);
}

/// Kernel width as a share of the threshold. Distances within a fabric are about half the threshold.
constexpr double kernelShare = 1.0 / 3;

/// Mean of the fabrics' spectra. The weight of a fabric is a Gaussian of the distance to its nearest photograph.
std::vector<double> ringsOfSimilarFabrics(const Familiarity& familiarity, const Standardised& point, double distance)
{
    std::vector<double> least(familiarity.fabricRings.size(), std::numeric_limits<double>::max());
    for (std::size_t i = 0; i < familiarity.nearest.size(); ++i) {
        double& fabric = least[static_cast<std::size_t>(familiarity.fabricOf[i])];
        fabric = std::min(fabric, squaredDistance(familiarity.nearest[i], point));
    }
    const double width = kernelShare * familiarity.threshold;
    std::vector<double> rings(familiarity.fabricRings.front().size(), 0);
    double total = 0;
    for (std::size_t fabric = 0; fabric < least.size(); ++fabric) {
        const double weight = std::exp((distance * distance - least[fabric]) / (2 * width * width));
        total += weight;
        for (std::size_t i = 0; i < rings.size(); ++i) rings[i] += weight * familiarity.fabricRings[fabric][i];
    }
    for (double& ring : rings) ring /= total;
    return rings;
}

void requireFeatures(std::span<const std::vector<float>> photographs)
{
    for (const std::vector<float>& features : photographs)
        if (features.size() != static_cast<std::size_t>(photographFeatureCount))
            throw protocols::badInput({"a photograph has " + std::to_string(features.size()) + " features", "familiarity",
                                       std::to_string(photographFeatureCount) + " features", "use photographFeatures()"});
}

void requireFabrics(const KnownFabrics& known, std::size_t photographs)
{
    const auto isThere = [&](int fabric) { return fabric >= 0 && static_cast<std::size_t>(fabric) < known.rings.size(); };
    if (!known.fabricOf.empty() && (known.fabricOf.size() != photographs || !std::ranges::all_of(known.fabricOf, isThere)))
        throw protocols::badInput({"photographs without a fabric", "familiarity", "the fabric of each photograph",
                                   "state one fabric for each training photograph"});
}

void fitScale(Familiarity& familiarity, std::span<const std::vector<float>> training)
{
    const auto count = static_cast<double>(training.size());
    for (std::size_t i = 0; i < static_cast<std::size_t>(photographFeatureCount); ++i) {
        double sum = 0, squares = 0;
        for (const std::vector<float>& features : training) sum += static_cast<double>(features[i]);
        const double mean = sum / count;
        for (const std::vector<float>& features : training) squares += std::pow(static_cast<double>(features[i]) - mean, 2);
        familiarity.mean.push_back(fourDigits(mean));
        familiarity.deviation.push_back(fourDigits(std::max(leastFeatureDeviation, std::sqrt(squares / count))));
    }
}

Standardised standardised(const Familiarity& familiarity, const std::vector<float>& features)
{
    Standardised point;
    for (std::size_t i = 0; i < features.size(); ++i)
        point.push_back((static_cast<double>(features[i]) - familiarity.mean[i]) / familiarity.deviation[i]);
    return point;
}

/// Indices in the order of choice: the first point, then always the point farthest from those chosen (the first of equals).
std::vector<std::size_t> spreadChoice(const std::vector<Standardised>& points)
{
    std::vector<double> apart(points.size(), std::numeric_limits<double>::max());
    std::vector<std::size_t> chosen;
    std::size_t next = 0;
    while (chosen.size() < static_cast<std::size_t>(mostPhotographsKept) && apart[next] > 0) {
        chosen.push_back(next);
        for (std::size_t i = 0; i < points.size(); ++i) apart[i] = std::min(apart[i], squaredDistance(points[next], points[i]));
        next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
    }
    return chosen;
}

std::vector<double> distancesAmong(const std::vector<Standardised>& points)
{
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<Standardised> others = points;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        if (!others.empty()) distances.push_back(distanceToNearest(others, points[i]));
    }
    return distances;
}

double thresholdOf(std::vector<double> distances)
{
    if (distances.empty()) return leastThreshold;
    std::sort(distances.begin(), distances.end());
    const auto at = static_cast<std::size_t>(std::ceil(familiarShare * static_cast<double>(distances.size()))) - 1;
    return std::max(leastThreshold, distances[std::min(at, distances.size() - 1)]);
}

bool sensible(const Familiarity& familiarity)
{
    const auto sound = [](const std::vector<double>& numbers) {
        return numbers.size() == static_cast<std::size_t>(photographFeatureCount) &&
               std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    };
    const auto ofAFabric = [&](int fabric) {
        return fabric >= 0 && static_cast<std::size_t>(fabric) < familiarity.fabricRings.size();
    };
    const auto soundRings = [](const std::vector<double>& rings) {
        return rings.size() == static_cast<std::size_t>(ringCount) &&
               std::all_of(rings.begin(), rings.end(), [](double ring) { return std::abs(ring) < 50; });
    };
    const bool soundMemory = familiarity.fabricOf.empty() ? familiarity.fabricRings.empty()
                                                          : familiarity.fabricOf.size() == familiarity.nearest.size() &&
                                                                std::ranges::all_of(familiarity.fabricOf, ofAFabric) &&
                                                                std::ranges::all_of(familiarity.fabricRings, soundRings);
    return soundMemory && sound(familiarity.mean) && sound(familiarity.deviation) && !familiarity.nearest.empty() &&
           std::all_of(familiarity.deviation.begin(), familiarity.deviation.end(), [](double sd) { return sd > 0; }) &&
           std::all_of(familiarity.nearest.begin(), familiarity.nearest.end(), sound) && std::isfinite(familiarity.threshold) &&
           familiarity.threshold > 0;
}

}  // namespace

Familiarity fitFamiliarity(std::span<const std::vector<float>> training, std::span<const std::vector<float>> validation,
                           const KnownFabrics& known)
{
    if (training.empty())
        throw protocols::badInput({"there are no training photographs", "familiarity", "at least one", "add photographs"});
    requireFeatures(training);
    requireFeatures(validation);
    requireFabrics(known, training.size());
    Familiarity familiarity;
    fitScale(familiarity, training);
    std::vector<Standardised> points;
    for (const std::vector<float>& features : training) points.push_back(standardised(familiarity, features));
    for (const std::size_t chosen : spreadChoice(points)) {
        familiarity.nearest.push_back(rounded(points[chosen]));
        if (!known.fabricOf.empty()) familiarity.fabricOf.push_back(known.fabricOf[chosen]);
    }
    for (const std::vector<double>& rings : known.rings) familiarity.fabricRings.push_back(rounded(rings));
    std::vector<double> distances;
    for (const std::vector<float>& features : validation)
        distances.push_back(distanceToNearest(familiarity.nearest, standardised(familiarity, features)));
    familiarity.threshold = fourDigits(thresholdOf(validation.empty() ? distancesAmong(familiarity.nearest) : distances));
    return familiarity;
}

Recognised recognised(const Familiarity& familiarity, const std::vector<float>& features)
{
    requireFeatures(std::span(&features, 1));
    const Standardised point = standardised(familiarity, features);
    const double distance = distanceToNearest(familiarity.nearest, point);
    return {distance, std::clamp(distance / familiarity.threshold - 1, 0.0, 1.0),
            familiarity.fabricOf.empty() ? std::vector<double>() : ringsOfSimilarFabrics(familiarity, point, distance)};
}

nlohmann::ordered_json familiarityJson(const Familiarity& familiarity)
{
    nlohmann::ordered_json json{{"features_mean", familiarity.mean},
                                {"features_sd", familiarity.deviation},
                                {"nearest", familiarity.nearest},
                                {"threshold", familiarity.threshold}};
    if (!familiarity.fabricOf.empty()) {
        json["fabric_of"] = familiarity.fabricOf;
        json["fabric_rings"] = familiarity.fabricRings;
    }
    return json;
}

Familiarity familiarityFrom(const nlohmann::ordered_json& json)
{
    Familiarity familiarity;
    familiarity.mean = json.at("features_mean").get<std::vector<double>>();
    familiarity.deviation = json.at("features_sd").get<std::vector<double>>();
    familiarity.nearest = json.at("nearest").get<std::vector<std::vector<double>>>();
    familiarity.threshold = json.at("threshold").get<double>();
    if (json.contains("fabric_of")) {
        familiarity.fabricOf = json.at("fabric_of").get<std::vector<int>>();
        familiarity.fabricRings = json.at("fabric_rings").get<std::vector<std::vector<double>>>();
    }
    if (!sensible(familiarity))
        throw protocols::badInput({"the numbers on known photographs are impossible", "photographs",
                                   std::to_string(photographFeatureCount) + " finite features of each",
                                   "copy the card again, or train again"});
    return familiarity;
}

}  // namespace rendering::models
