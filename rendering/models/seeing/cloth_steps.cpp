#include "rendering/models/seeing/cloth_steps.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "rendering/models/seeing/relief_losses.h"
#include "rendering/models/seeing/seen_texture.h"
#include "rendering/models/seeing/told_lamp.h"

namespace rendering::models {

namespace {

constexpr int warmUpSteps = 100;
/// Decay of the moving average of the weights: the share of the average that remains after each step.
constexpr double averageDecay = 0.998;
constexpr double largestGradient = 1;

torch::Tensor tensorOf(std::vector<float>& values, std::vector<std::int64_t> shape)
{
    return torch::from_blob(values.data(), shape, torch::kFloat).clone();
}

struct ClothTensors {
    torch::Tensor photographs, reliefs, logPitches, logFrictions, lamps, logRatios;
};

ClothTensors tensorsOf(ClothBatch batch)
{
    return {tensorOf(batch.photographs, {batch.size, 3, batch.side, batch.side}),
            tensorOf(batch.reliefs, {batch.size, 1, batch.side, batch.side}),
            tensorOf(batch.logPitches, {batch.size, 1}),
            tensorOf(batch.logFrictions, {batch.size, 1}),
            tensorOf(batch.lamps, {batch.size, lampNumbers}),
            tensorOf(batch.logRatios, {batch.size, static_cast<std::int64_t>(batch.logRatios.size()) / batch.size})};
}

/// Mean negative log-likelihood of a normal distribution over the patches with known friction; 0 where none has.
torch::Tensor frictionLoss(const SeenFriction& seen, const torch::Tensor& logFrictions)
{
    const torch::Tensor known = torch::isfinite(logFrictions);
    const torch::Tensor error = (seen.logMean - torch::where(known, logFrictions, seen.logMean.detach())) / seen.logSpread.exp();
    const torch::Tensor each = torch::where(known, 0.5 * error.square() + seen.logSpread, torch::zeros_like(error));
    return each.sum() / known.sum().clamp_min(1);
}

/// Mean absolute difference over the patches with a stroke; 0 where none has.
torch::Tensor spectrogramLoss(const SeenFriction& seen, const torch::Tensor& logRatios)
{
    const torch::Tensor made = seen.logRatio.flatten(1), known = torch::isfinite(logRatios);
    return (made - torch::where(known, logRatios, made.detach())).abs().sum() / known.sum().clamp_min(1);
}

double medianOf(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double quantileOf(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double meanOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Six decimals, enough for comparisons.
double sixDecimals(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

ClothTraining::ClothTraining(const Architecture& architecture, const std::vector<ScannedCloth>& scans,
                             const ClothTrainingOptions& options)
    : m_scans(scans),
      m_architecture(architecture),
      m_options(options),
      m_networks(makeSeeingNetworks(architecture)),
      m_average(makeSeeingNetworks(architecture)),
      m_steps(parametersOf(m_networks), torch::optim::AdamOptions(options.learningRate))
{
    moveTowards(m_average, m_networks, 1);
}

void ClothTraining::startFrom(SeeingNetworks& networks)
{
    moveTowards(m_networks, networks, 1);
    moveTowards(m_average, networks, 1);
}

ClothBatch ClothTraining::takeBatch(int number)
{
    ClothBatchOptions options;
    options.size = m_options.batch;
    options.side = m_options.side;
    options.scanShare = m_options.scanShare;
    options.spectrograms = m_architecture;
    const auto draw = [this, options](int wanted) {
        return drawClothBatch(m_scans, options, m_options.seed, static_cast<std::uint64_t>(wanted));
    };
    ClothBatch now = m_next.valid() && m_nextNumber == number ? m_next.get() : draw(number);
    m_nextNumber = number + 1;
    m_next = std::async(std::launch::async, draw, m_nextNumber);
    return now;
}

ClothLosses ClothTraining::step(int number, double fraction)
{
    const double fall = 0.02 + 0.98 * 0.5 * (1 + std::cos(std::numbers::pi * fraction));
    for (torch::optim::OptimizerParamGroup& group : m_steps.param_groups())
        static_cast<torch::optim::AdamOptions&>(group.options())
            .lr(m_options.learningRate * fall * std::min(1.0, (number + 1.0) / warmUpSteps));
    const ClothTensors batch = tensorsOf(takeBatch(number));
    m_steps.zero_grad();
    const torch::Tensor texture = seenTexture(batch.photographs);
    const torch::Tensor relief = m_networks.relief->forward(texture, batch.lamps);
    const SeenFriction friction = m_networks.friction->forward(texture, relief, batch.logPitches);
    const torch::Tensor ofRelief = reliefLoss(relief, batch.reliefs, {});
    const torch::Tensor ofFriction = frictionLoss(friction, batch.logFrictions);
    const torch::Tensor ofSpectrogram = spectrogramLoss(friction, batch.logRatios);
    (ofRelief + ofFriction + ofSpectrogram).backward();
    torch::nn::utils::clip_grad_norm_(m_networks.relief->parameters(), largestGradient);
    torch::nn::utils::clip_grad_norm_(m_networks.friction->parameters(), largestGradient);
    m_steps.step();
    // The average follows faster during the first steps, because the early networks are still poor.
    moveTowards(m_average, m_networks, 1 - std::min(averageDecay, (number + 1.0) / (number + 10.0)));
    return {ofRelief.item<double>(), ofFriction.item<double>(), ofSpectrogram.item<double>()};
}

bool ClothTraining::finite()
{
    const std::vector<torch::Tensor> parameters = parametersOf(m_networks);
    return std::all_of(parameters.begin(), parameters.end(),
                       [](const torch::Tensor& one) { return torch::isfinite(one).all().item<bool>(); });
}

std::vector<StoredTensor> ClothTraining::tensors()
{
    std::vector<StoredTensor> all;
    for (const auto& [prefix, networks] : {std::pair{"now.", &m_networks}, {"average.", &m_average}})
        for (const NamedTensor& one : models::tensorsOf(prefix, *networks)) all.push_back(storedTensor(one.name, one.tensor));
    for (StoredTensor& one : momentsOf("steps.", m_steps)) all.push_back(std::move(one));
    return all;
}

void ClothTraining::continueFrom(const std::vector<StoredTensor>& tensors)
{
    const torch::NoGradGuard noGradient;
    std::size_t next = 0;
    for (SeeingNetworks* networks : {&m_networks, &m_average})
        for (NamedTensor& one : models::tensorsOf({}, *networks)) copyInto(one.tensor, tensors.at(next++));
    setMoments(m_steps, tensors, next);
}

namespace {

constexpr double ninetyPercent = 1.6448536269514722;  ///< standard deviations on each side of a normal 90 % interval

/// What the networks make of a patch, beside what is known.
struct SeenPatch {
    double correlation = 0, sqRatio = 0;
    double logError = 0, logSpread = 0, friction = 0;  ///< of the mean friction: error of its logarithm, stated deviation, truth
    double standardError() const { return std::abs(logError) / std::exp(logSpread); }
};

std::vector<SeenPatch> seenPatches(SeeingNetworks& networks, const Architecture& architecture, int patches, std::uint64_t family)
{
    const torch::NoGradGuard noGradient;
    setTraining(networks, false);
    ClothBatchOptions options;
    options.side = architecture.crop;
    options.spectrograms = architecture;
    std::vector<SeenPatch> all;
    for (int number = 0; number * options.size < patches; ++number) {
        const ClothTensors batch = tensorsOf(drawClothBatch({}, options, family, static_cast<std::uint64_t>(number)));
        const torch::Tensor texture = seenTexture(batch.photographs);
        const torch::Tensor relief = networks.relief->forward(texture, batch.lamps);
        const SeenFriction friction = networks.friction->forward(texture, relief, batch.logPitches);
        const torch::Tensor correlation = reliefCorrelation(relief, batch.reliefs);
        const torch::Tensor ratio = withoutSlowPart(relief).flatten(1).std(1) / withoutSlowPart(batch.reliefs).flatten(1).std(1);
        for (int i = 0; i < options.size; ++i) {
            const double known = batch.logFrictions[i].item<double>();
            all.push_back({correlation[i].item<double>(), ratio[i].item<double>(), friction.logMean[i].item<double>() - known,
                           friction.logSpread[i].item<double>(), std::exp(known)});
        }
    }
    setTraining(networks, true);
    return all;
}

}  // namespace

double frictionIntervalFactor(SeeingNetworks& networks, const Architecture& architecture, int patches, std::uint64_t seed)
{
    constexpr std::uint64_t ownFamily = 0x9e3779b97f4a7c15;  // Neither of training nor of its validation.
    std::vector<double> errors;
    for (const SeenPatch& patch : seenPatches(networks, architecture, patches, seed ^ ownFamily))
        errors.push_back(patch.standardError());
    return std::clamp(quantileOf(errors, 0.9) / ninetyPercent, 0.2, 5.0);
}

nlohmann::ordered_json clothFigures(SeeingNetworks& networks, const Architecture& architecture, int patches, std::uint64_t seed)
{
    std::vector<double> correlations, ratios, errors, truths, constantErrors;
    double covered = 0;
    // Families are far apart: training draws from `seed`, validation from its complement.
    for (const SeenPatch& patch : seenPatches(networks, architecture, patches, ~seed)) {
        correlations.push_back(patch.correlation);
        ratios.push_back(patch.sqRatio);
        errors.push_back(std::abs(std::expm1(patch.logError)));
        truths.push_back(patch.friction);
        covered += patch.standardError() <= ninetyPercent * architecture.intervalFactor ? 1 : 0;
    }
    const double constant = medianOf(truths);
    for (const double truth : truths) constantErrors.push_back(std::abs(constant / truth - 1));
    return {{"patches", correlations.size()},
            {"relief_correlation", sixDecimals(meanOf(correlations))},
            {"relief_correlation_median", sixDecimals(medianOf(correlations))},
            {"sq_ratio_low", sixDecimals(quantileOf(ratios, 0.05))},
            {"sq_ratio_high", sixDecimals(quantileOf(ratios, 0.95))},
            {"friction_error", sixDecimals(meanOf(errors))},
            {"friction_constant_error", sixDecimals(meanOf(constantErrors))},
            {"friction_coverage", sixDecimals(covered / static_cast<double>(truths.size()))}};
}

}  // namespace rendering::models
