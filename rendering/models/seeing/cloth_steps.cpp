#include "rendering/models/seeing/cloth_steps.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "rendering/models/seeing/relief_losses.h"
#include "rendering/models/seeing/seen_texture.h"
#include "rendering/models/seeing/told_lamp.h"

namespace rendering::models {

namespace {

constexpr int warmUpSteps = 100;

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

/// The weights of the losses of this process in those of the whole batch: its share of the patches, and of those with known
/// friction.
struct LossShares {
    double relief = 1, friction = 1, spectrogram = 1;
};

LossShares lossShares(const ClothTensors& batch, const TrainingPeers& peers)
{
    const auto known = [](const torch::Tensor& numbers) { return torch::isfinite(numbers).sum().item<double>(); };
    const torch::Tensor own = torch::tensor(
        {static_cast<double>(batch.reliefs.size(0)), known(batch.logFrictions), known(batch.logRatios)}, torch::kDouble);
    torch::Tensor all = own.clone();
    peers.sum(all);
    const torch::Tensor shares = own / all.clamp_min(1);
    return {shares[0].item<double>(), shares[1].item<double>(), shares[2].item<double>()};
}

/// Six decimals, enough for comparisons.
double sixDecimals(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

ClothObjective::Losses ClothObjective::of(const ClothTensors& batch, const torch::Tensor& relief, const SeenFriction& friction,
                                          double)
{
    return {reliefLoss(relief, batch.reliefs, {}), frictionLoss(friction, batch.logFrictions),
            spectrogramLoss(friction, batch.logRatios)};
}

void ClothObjective::continueFrom(const std::vector<StoredTensor>&, std::size_t&) {}

ClothTraining::ClothTraining(const Architecture& architecture, const std::vector<ScannedCloth>& scans,
                             const ClothTrainingOptions& options)
    : m_scans(scans),
      m_architecture(architecture),
      m_options(options),
      m_trained(architecture),
      m_objective(options.makeObjective ? options.makeObjective(architecture) : std::make_unique<ClothObjective>())
{
}

ClothBatch ClothTraining::takeBatch(int number)
{
    ClothBatchOptions options;
    options.size = m_options.batch;
    options.side = m_options.side;
    options.scanShare = m_options.scanShare;
    options.spectrograms = m_architecture;
    if (m_peers != nullptr) {
        const auto [processes, rank, master, wait] = m_peers->place();
        options.firstRow = m_options.batch * rank / processes;
        options.rows = m_options.batch * (rank + 1) / processes - options.firstRow;
    }
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
    const ClothTensors batch = clothTensors(takeBatch(number));
    const torch::Tensor texture = seenTexture(batch.photographs);
    const torch::Tensor relief = m_trained.now().relief->forward(texture, batch.lamps);
    const SeenFriction friction = m_trained.now().friction->forward(texture, relief, batch.logPitches);
    const double rate = learningRateAt(m_options.learningRate, fraction, number, warmUpSteps);
    const auto [ofRelief, ofFriction, ofSpectrogram] = m_objective->of(batch, relief, friction, rate);
    if (m_peers == nullptr) {
        m_trained.step(ofRelief + ofFriction + ofSpectrogram, rate, number);
        return {ofRelief.item<double>(), ofFriction.item<double>(), ofSpectrogram.item<double>()};
    }
    const LossShares shares = lossShares(batch, *m_peers);
    m_trained.step(shares.relief * ofRelief + shares.friction * ofFriction + shares.spectrogram * ofSpectrogram, rate, number);
    torch::Tensor losses = torch::tensor({shares.relief * ofRelief.item<double>(), shares.friction * ofFriction.item<double>(),
                                          shares.spectrogram * ofSpectrogram.item<double>()},
                                         torch::kDouble);
    m_peers->sum(losses);
    return {losses[0].item<double>(), losses[1].item<double>(), losses[2].item<double>()};
}

void ClothTraining::shareWith(const TrainingPeers& peers)
{
    std::vector<StoredTensor> numbers = tensors();
    for (StoredTensor& one : numbers) peers.takeFromFirst(one.bytes);
    continueFrom(numbers);
    m_trained.shareWith(peers);
    m_peers = &peers;
}

std::vector<StoredTensor> ClothTraining::tensors()
{
    std::vector<StoredTensor> all = m_trained.tensors();
    for (StoredTensor& one : m_objective->tensors()) all.push_back(std::move(one));
    return all;
}

void ClothTraining::continueFrom(const std::vector<StoredTensor>& tensors)
{
    std::size_t next = 0;
    m_trained.continueFrom(tensors, next);
    m_objective->continueFrom(tensors, next);
}

std::vector<ClothBatch> drawnBatches(const Architecture& architecture, int patches, std::uint64_t family)
{
    ClothBatchOptions options;
    options.side = architecture.crop;
    options.spectrograms = architecture;
    std::vector<ClothBatch> batches;
    for (int number = 0; number * options.size < patches; ++number)
        batches.push_back(drawClothBatch({}, options, family, static_cast<std::uint64_t>(number)));
    return batches;
}

std::vector<SeenPatch> seenPatches(SeeingNetworks& networks, const std::vector<ClothBatch>& batches)
{
    const torch::NoGradGuard noGradient;
    setTraining(networks, false);
    std::vector<SeenPatch> all;
    for (const ClothBatch& drawn : batches) {
        const ClothTensors batch = clothTensors(drawn);
        const torch::Tensor texture = seenTexture(batch.photographs);
        const torch::Tensor relief = networks.relief->forward(texture, batch.lamps);
        const SeenFriction friction = networks.friction->forward(texture, relief, batch.logPitches);
        const torch::Tensor correlation = reliefCorrelation(relief, batch.reliefs);
        const torch::Tensor ratio = withoutSlowPart(relief).flatten(1).std(1) / withoutSlowPart(batch.reliefs).flatten(1).std(1);
        for (int i = 0; i < drawn.size; ++i) {
            const double known = batch.logFrictions[i].item<double>();
            all.push_back({correlation[i].item<double>(), ratio[i].item<double>(), friction.logMean[i].item<double>() - known,
                           friction.logSpread[i].item<double>(), std::exp(known), drawn.fibres[std::size_t(i)].value()});
        }
    }
    setTraining(networks, true);
    return all;
}

void calibrateFriction(SeeingNetworks& networks, Architecture& architecture, int patches, std::uint64_t seed)
{
    constexpr std::uint64_t ownFamily = 0x9e3779b97f4a7c15;  // Neither of training nor of its validation.
    const std::vector<SeenPatch> seen = seenPatches(networks, drawnBatches(architecture, patches, seed ^ ownFamily));
    std::vector<double> errors;
    for (const SeenPatch& patch : seen) errors.push_back(patch.standardError());
    architecture.intervalFactor = std::clamp(quantileOf(errors, 0.9) / ninetyPercent, 0.2, 5.0);
    std::vector<DrawnReading> drawn;
    for (const SeenPatch& patch : seen) {
        const double known = std::log(patch.friction);
        drawn.push_back({patch.fibre,
                         {known + patch.logError, ninetyPercent * architecture.intervalFactor * std::exp(patch.logSpread)},
                         known});
    }
    architecture.fibres = fibreReadings(drawn);
}

nlohmann::ordered_json clothFigures(SeeingNetworks& networks, const Architecture& architecture, int patches, std::uint64_t seed)
{
    std::vector<double> correlations, ratios, errors, truths, constantErrors;
    double covered = 0;
    // Families are far apart: training draws from `seed`, validation from its complement.
    for (const SeenPatch& patch : seenPatches(networks, drawnBatches(architecture, patches, ~seed))) {
        correlations.push_back(patch.correlation);
        ratios.push_back(patch.sqRatio);
        errors.push_back(patch.frictionError());
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
