#include "rendering/models/networks/adversarial_training.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/models/networks/batch_tensors.h"

namespace rendering::models {

namespace {

constexpr int warmUpSteps = 50;
/// Decay of the exponential moving average: the share of the average that remains after each step.
constexpr double averageDecay = 0.995;

/// Parameters and running statistics in a fixed order.
std::vector<torch::Tensor> stateOf(const Generators& generators)
{
    std::vector<torch::Tensor> all = parametersOf(generators);
    for (const torch::nn::Module* module : {static_cast<const torch::nn::Module*>(generators.height.get()),
                                            static_cast<const torch::nn::Module*>(generators.friction.get())})
        for (const torch::Tensor& buffer : module->buffers()) all.push_back(buffer);
    return all;
}

/// Moves `to` towards `from` by `share` of the difference; 1 copies.
void moveTowards(const Generators& to, const Generators& from, double share)
{
    const torch::NoGradGuard noGradient;
    const std::vector<torch::Tensor> targets = stateOf(to), sources = stateOf(from);
    for (std::size_t i = 0; i < targets.size(); ++i) {
        torch::Tensor target = targets[i];
        if (share >= 1 || !target.is_floating_point())
            target.copy_(sources[i]);
        else
            target.lerp_(sources[i], share);
    }
}

}  // namespace

LossWeights weightsFor(Objective objective)
{
    switch (objective) {
        case Objective::Default:
            return defaultWeights();
        case Objective::Reference:
            return referenceWeights();
        case Objective::L1Only:
            return l1OnlyWeights();
    }
    return {};
}

DistanceScales scalesOf(const TrainingData& data)
{
    return {data.architecture.meanFrictionScale, data.heightRangeMm / data.architecture.heightScaleMm};
}

AdversarialTraining::AdversarialTraining(const TrainingData& data, const TrainingOptions& options)
    : m_data(data),
      m_options(options),
      m_weights(weightsFor(options.objective)),
      m_generators(makeGenerators(data.architecture)),
      m_average(makeGenerators(data.architecture)),
      m_best(makeGenerators(data.architecture)),
      m_discriminator(data.architecture, m_weights.adversary),
      m_generatorSteps(adversarialAdam(parametersOf(m_generators)))
{
    moveTowards(m_average, m_generators, 1);
    moveTowards(m_best, m_generators, 1);
}

AdversarialTraining::DrawnBatches AdversarialTraining::drawBatches(int number) const
{
    protocols::Random random = protocols::Random::stream(m_options.seed, "step/" + std::to_string(number));
    BatchOptions pairs;
    pairs.size = m_options.batch;
    pairs.margin = weightsFor(m_options.objective).adversary == Adversary::Hinge ? registrationMarginPx : 0;
    BatchOptions strokes = pairs;
    strokes.heights = false;
    return {drawBatch(m_data, m_data.training, pairs, random), drawBatch(m_data, m_data.training, strokes, random)};
}

AdversarialTraining::DrawnBatches AdversarialTraining::takeBatches(int number)
{
    DrawnBatches now = m_next.valid() && m_nextNumber == number ? m_next.get() : drawBatches(number);
    m_nextNumber = number + 1;
    m_next = std::async(std::launch::async, [this, next = m_nextNumber] { return drawBatches(next); });
    return now;
}

double AdversarialTraining::rateAt(int number, double fraction) const
{
    const double fall = 0.02 + 0.98 * 0.5 * (1 + std::cos(std::numbers::pi * fraction));
    return m_options.learningRate * fall * std::min(1.0, (number + 1.0) / warmUpSteps);
}

StepLosses AdversarialTraining::step(int number, double fraction)
{
    const double rate = rateAt(number, fraction);
    setLearningRate(m_generatorSteps, rate);
    DrawnBatches both = takeBatches(number);
    const TensorBatch pairs = tensorsOf(std::move(both.pairs)), strokes = tensorsOf(std::move(both.strokes));
    // G_s is cheap and its target is noisy, so it gets twice as many photographs and strokes.
    const FrictionOutput all = m_generators.friction->forward(torch::cat({pairs.photograph, strokes.photograph}, 0));
    const std::int64_t size = pairs.photograph.size(0);
    // A reference training has no loss on the spectrum, so it is not computed.
    const torch::Tensor rings = m_weights.rings > 0 ? m_generators.height->rings(pairs.photograph) : torch::Tensor();
    const BatchSignals generated{
        m_generators.height->forward(pairs.photograph), rings, {all.logRatio.narrow(0, 0, size), all.mean.narrow(0, 0, size)}};
    const BatchSignals measured = pairs.measuredFor(generated.height);
    StepLosses losses;
    if (m_weights.adversarial > 0) losses.discriminator = m_discriminator.step(pairs.photograph, measured, generated, rate);

    m_generatorSteps.zero_grad();
    const BatchSignals compared{generated.height, rings, all};
    const BatchSignals truth{measured.height,
                             measured.rings,
                             {torch::cat({measured.friction.logRatio, strokes.friction.logRatio}, 0),
                              torch::cat({measured.friction.mean, strokes.friction.mean}, 0)}};
    const torch::Tensor weightedDistance = distance(compared, truth, m_weights, scalesOf(m_data));
    torch::Tensor sum = weightedDistance;
    if (m_weights.adversarial > 0) {
        const torch::Tensor adversarial = m_discriminator.lossOf(pairs.photograph, generated);
        losses.generators = adversarial.item<double>();
        sum = sum + m_weights.adversarial * adversarial;
    }
    sum.backward();
    m_generatorSteps.step();
    losses.distance = weightedDistance.item<double>();
    updateAverage(number);
    return losses;
}

/// The average follows faster during the first steps, because the early networks are still poor.
void AdversarialTraining::updateAverage(int number)
{
    if (averages()) moveTowards(m_average, m_generators, 1 - std::min(averageDecay, (number + 1.0) / (number + 10.0)));
}

bool AdversarialTraining::finite()
{
    for (const torch::Tensor& parameter : parametersOf(m_generators))
        if (!torch::isfinite(parameter).all().item<bool>()) return false;
    return true;
}

void AdversarialTraining::keepAsBest() { moveTowards(m_best, result(), 1); }

std::vector<NamedTensor> AdversarialTraining::networkTensors() const
{
    const std::pair<const char*, const torch::nn::Module*> networks[] = {
        {"height.", m_generators.height.get()},      {"friction.", m_generators.friction.get()},
        {"average_height.", m_average.height.get()}, {"average_friction.", m_average.friction.get()},
        {"best_height.", m_best.height.get()},       {"best_friction.", m_best.friction.get()}};
    std::vector<NamedTensor> all;
    for (const auto& [prefix, network] : networks)
        for (NamedTensor& one : tensorsOfModule(prefix, *network)) all.push_back(std::move(one));
    for (NamedTensor& one : m_discriminator.networkTensors()) all.push_back(std::move(one));
    return all;
}

std::vector<StoredTensor> AdversarialTraining::tensors()
{
    std::vector<StoredTensor> all;
    for (const NamedTensor& one : networkTensors()) all.push_back(storedTensor(one.name, one.tensor));
    for (StoredTensor& one : momentsOf("generator_steps.", m_generatorSteps)) all.push_back(std::move(one));
    for (StoredTensor& one : momentsOf("discriminator_steps.", m_discriminator.optimiser())) all.push_back(std::move(one));
    return all;
}

void AdversarialTraining::continueFrom(const std::vector<StoredTensor>& tensors)
{
    std::size_t next = 0;
    for (NamedTensor& one : networkTensors()) copyInto(one.tensor, tensors.at(next++));
    setMoments(m_generatorSteps, tensors, next);
    setMoments(m_discriminator.optimiser(), tensors, next);
}

}  // namespace rendering::models
