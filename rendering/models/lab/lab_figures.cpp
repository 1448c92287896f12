#include "rendering/models/lab/lab_figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/core.hpp>
#include <set>

#include "rendering/models/lab/lab_heights.h"
#include "rendering/models/seeing/seen_signals.h"
#include "rendering/models/seeing/slow_relief.h"

namespace rendering::models {

namespace {

constexpr int figureSidePx = 384;  ///< of the middle that figures are computed from
constexpr double leastShareForFigures = 0.1;
constexpr std::size_t pressesForFigures = 8;
/// Spread of the scales of laboratories, and of one fabric's distance from its laboratory's, as logarithms.
constexpr double spreadOfLabs = 0.4, leastSpreadOfFabrics = 0.12;
/// Added to both sides of a ratio of measures, so that tiny ones do not decide.
constexpr double scoreFloor = 0.02;

cv::Rect middlePart(const cv::Size& size)
{
    const int width = std::min(size.width, figureSidePx), height = std::min(size.height, figureSidePx);
    return {(size.width - width) / 2, (size.height - height) / 2, width, height};
}

/// Deviation without slow parts at the coarser of both pitches. Slow is what it is in the photograph's own pixels.
double comparableDeviation(const cv::Mat& heightMm, double mmPerPixel, double coarserMmPerPixel, double photographMmPerPixel)
{
    const cv::Mat map = scaledHeights(heightMm, mmPerPixel / coarserMmPerPixel);
    return deviationOf(withoutSlowHeights(map, slowSigmaPx * photographMmPerPixel / coarserMmPerPixel));
}

/// Logarithm of generated Sq over that of presses of the fabric: of the same part where it has any.
std::optional<double> againstPresses(const cv::Mat& generatedMm, const LabPhotograph& photograph, const LabCloth& lab)
{
    std::vector<const cv::Mat*> ofPart, all;
    for (const LabPress& press : lab.fabrics[photograph.fabric].presses) {
        all.push_back(&press.heightMm);
        if (press.part == photograph.part) ofPart.push_back(&press.heightMm);
    }
    if (ofPart.empty() && photograph.part == LabPart::Training) return std::nullopt;
    const std::vector<const cv::Mat*>& presses = ofPart.empty() ? all : ofPart;
    const std::size_t used = std::min(presses.size(), pressesForFigures);
    const double coarser = std::max(lab.pressMmPerPixel, photograph.mmPerPixel);
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < used; ++i) {
        const double deviation =
            comparableDeviation(*presses[i * presses.size() / used], lab.pressMmPerPixel, coarser, photograph.mmPerPixel);
        if (!(deviation > 0)) continue;
        sum += std::log(deviation);
        ++count;
    }
    const double own = comparableDeviation(generatedMm, photograph.mmPerPixel, coarser, photograph.mmPerPixel);
    if (count == 0 || !(own > 0)) return std::nullopt;
    return std::log(own) - sum / count;
}

void compareRegistered(SeenLabPhotograph& seen, const cv::Mat& generatedMm, const cv::Mat& measuredMm, bool amplitudeKnown)
{
    cv::Mat generated = generatedMm.clone();
    generated.setTo(cv::Scalar(std::numeric_limits<float>::quiet_NaN()), measuredMm != measuredMm);
    generated = withoutSlowHeights(generated, slowSigmaPx);
    const cv::Mat measured = withoutSlowHeights(measuredMm, slowSigmaPx);
    const double correlation = correlationOfHeights(generated, measured);
    if (std::isfinite(correlation)) seen.correlation = correlation;
    const double ratio = deviationOf(generated) / deviationOf(measured);
    if (amplitudeKnown && std::isfinite(ratio) && ratio > 0) seen.logSqRatio = std::log(ratio);
}

SeenLabPhotograph seenPhotograph(SeeingNetworks& networks, const Architecture& architecture, const LabCloth& lab,
                                 const LabPhotograph& photograph)
{
    const cv::Rect part = middlePart(photograph.rgb.size());
    const GeneratedSignals made = seenSignals(
        networks, architecture, {photograph.rgb(part).clone(), photograph.mmPerPixel, photograph.lightDeg, photograph.fibre}, {});
    SeenLabPhotograph seen;
    seen.fabric = photograph.fabric;
    const double measured = lab.fabrics[photograph.fabric].logFriction(photograph.part);
    if (std::isfinite(measured)) {
        seen.logFrictionError = std::log(made.meanFriction) - measured;
        const FrictionInterval& interval = *made.photograph.meanFriction;
        seen.intervalShare = std::abs(*seen.logFrictionError) / (0.5 * std::log(interval.high / interval.low));
    }
    if (!photograph.reliefMm.empty() && measuredShare(photograph.reliefMm(part)) >= leastShareForFigures)
        compareRegistered(seen, made.heightMm, photograph.reliefMm(part), photograph.amplitudeKnown);
    else if (photograph.reliefMm.empty())
        seen.logSqRatio = againstPresses(made.heightMm, photograph, lab);
    return seen;
}

double medianOfValues(std::vector<double> values)
{
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Means of a measure over the photographs of each fabric.
template <class Measure>
std::vector<double> fabricMeans(const std::vector<SeenLabPhotograph>& seen, Measure measure)
{
    std::map<std::size_t, std::pair<double, int>> sums;
    for (const SeenLabPhotograph& one : seen)
        if (const std::optional<double> value = measure(one)) {
            sums[one.fabric].first += *value;
            ++sums[one.fabric].second;
        }
    std::vector<double> means;
    for (const auto& [fabric, sum] : sums) means.push_back(sum.first / sum.second);
    return means;
}

/// Factor that brings the median to 0, drawn towards 1: the spread of fabrics says how much their median tells of the lab.
double shrunkenFactor(const std::vector<double>& logarithms)
{
    if (logarithms.empty()) return 1;
    const double middle = medianOfValues(logarithms);
    double sum = 0;
    for (const double value : logarithms) sum += (value - middle) * (value - middle);
    const auto count = static_cast<double>(logarithms.size());
    const double spread = std::max(leastSpreadOfFabrics * leastSpreadOfFabrics, sum / count);
    const double told = spreadOfLabs * spreadOfLabs / (spreadOfLabs * spreadOfLabs + spread / count);
    return std::clamp(std::exp(-told * middle), 0.05, 20.0);
}

std::optional<double> quotient(double sum, int count) { return count > 0 ? std::optional(sum / count) : std::nullopt; }

/// Adds the quotient of two measures that are better the smaller they are.
void addQuotient(std::vector<double>& quotients, const std::optional<double>& before, const std::optional<double>& after)
{
    if (before && after) quotients.push_back((*after + scoreFloor) / (*before + scoreFloor));
}

std::optional<double> distanceFromOne(const std::optional<double>& correlation)
{
    return correlation ? std::optional(1 - *correlation) : std::nullopt;
}

/// `worse[i]`: what fabric i lost; `before`: the mean figure before.
ShippedAbility abilityOf(double before, double after, const std::vector<double>& worse)
{
    const auto count = static_cast<double>(worse.size());
    const double mean = std::accumulate(worse.begin(), worse.end(), 0.0) / count;
    double squares = 0;
    for (const double value : worse) squares += (value - mean) * (value - mean);
    const double error = std::sqrt(squares / std::max(1.0, count - 1) / count);
    const double unit = 100 / std::max(1e-6, std::abs(before));
    return {before, after, unit * mean, unit * (mean + ninetyPercent * error)};
}

double rounded(double value, double steps = 1e4) { return std::round(value * steps) / steps; }

nlohmann::ordered_json numberOrNull(const std::optional<double>& value)
{
    return value ? nlohmann::ordered_json(rounded(*value)) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json asJson(const ShippedAbility& ability)
{
    return {{"before", rounded(ability.before)},
            {"after", rounded(ability.after)},
            {"worse_percent", rounded(ability.worsePercent, 100)},
            {"worse_percent_at_most", rounded(ability.atMostPercent, 100)}};
}

}  // namespace

std::vector<SeenLabPhotograph> seenLab(SeeingNetworks& networks, const Architecture& architecture, const LabCloth& lab,
                                       LabPart part, int most)
{
    const std::vector<std::size_t> all = lab.photographsOf(part);
    const std::size_t count = std::min(all.size(), static_cast<std::size_t>(most));
    setTraining(networks, false);
    std::vector<SeenLabPhotograph> seen;
    for (std::size_t i = 0; i < count; ++i)
        seen.push_back(seenPhotograph(networks, architecture, lab, lab.photographs[all[i * all.size() / count]]));
    return seen;
}

LabFigures labFigures(const std::vector<SeenLabPhotograph>& seen)
{
    LabFigures figures;
    figures.photographs = static_cast<int>(seen.size());
    std::set<std::size_t> fabrics;
    double friction = 0, logSq = 0, sqError = 0, correlation = 0;
    int sqCount = 0, correlations = 0;
    for (const SeenLabPhotograph& one : seen) {
        fabrics.insert(one.fabric);
        if (one.logFrictionError) {
            friction += std::abs(std::expm1(*one.logFrictionError));
            ++figures.frictionPhotographs;
            figures.insideInterval += one.intervalShare <= 1 ? 1 : 0;
        }
        if (one.logSqRatio) {
            logSq += *one.logSqRatio;
            sqError += std::abs(*one.logSqRatio);
            ++sqCount;
        }
        if (one.correlation) {
            correlation += *one.correlation;
            ++correlations;
        }
    }
    figures.fabrics = static_cast<int>(fabrics.size());
    figures.frictionError = quotient(friction, figures.frictionPhotographs);
    if (sqCount > 0) figures.sqRatio = std::exp(logSq / sqCount);
    figures.sqError = quotient(sqError, sqCount);
    figures.correlation = quotient(correlation, correlations);
    return figures;
}

nlohmann::ordered_json asJson(const LabFigures& figures)
{
    return {{"photographs", figures.photographs},
            {"fabrics", figures.fabrics},
            {"friction_error", numberOrNull(figures.frictionError)},
            {"friction_photographs", figures.frictionPhotographs},
            {"friction_inside_interval", figures.insideInterval},
            {"sq_ratio", numberOrNull(figures.sqRatio)},
            {"sq_error", numberOrNull(figures.sqError)},
            {"correlation", numberOrNull(figures.correlation)}};
}

LabFactors labFactors(const std::vector<SeenLabPhotograph>& training)
{
    return {shrunkenFactor(fabricMeans(training, [](const SeenLabPhotograph& one) { return one.logFrictionError; })),
            shrunkenFactor(fabricMeans(training, [](const SeenLabPhotograph& one) { return one.logSqRatio; }))};
}

double labScore(const std::vector<LabFigures>& before, const std::vector<LabFigures>& after)
{
    std::vector<double> quotients;
    for (std::size_t i = 0; i < before.size(); ++i) {
        addQuotient(quotients, before[i].frictionError, after[i].frictionError);
        addQuotient(quotients, before[i].sqError, after[i].sqError);
        addQuotient(quotients, distanceFromOne(before[i].correlation), distanceFromOne(after[i].correlation));
    }
    if (quotients.empty()) return 1;
    return std::accumulate(quotients.begin(), quotients.end(), 0.0) / static_cast<double>(quotients.size());
}

ShippedAbilities shippedAbilities(const std::vector<SeenPatch>& before, const std::vector<SeenPatch>& after)
{
    double correlations[2] = {}, errors[2] = {};
    std::vector<double> lostCorrelation, addedError;
    for (std::size_t i = 0; i < before.size(); ++i) {
        correlations[0] += before[i].correlation;
        correlations[1] += after[i].correlation;
        errors[0] += before[i].frictionError();
        errors[1] += after[i].frictionError();
        lostCorrelation.push_back(before[i].correlation - after[i].correlation);
        addedError.push_back(after[i].frictionError() - before[i].frictionError());
    }
    const auto count = static_cast<double>(before.size());
    return {static_cast<int>(before.size()), abilityOf(correlations[0] / count, correlations[1] / count, lostCorrelation),
            abilityOf(errors[0] / count, errors[1] / count, addedError)};
}

nlohmann::ordered_json asJson(const ShippedAbilities& abilities)
{
    return {{"fabrics", abilities.fabrics},
            {"relief_correlation", asJson(abilities.relief)},
            {"friction_error", asJson(abilities.friction)}};
}

}  // namespace rendering::models
