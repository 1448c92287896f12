#include "rendering/models/networks/paper_objective.h"

#include "rendering/models/networks/adversarial_training.h"
#include "rendering/models/networks/discriminator_training.h"
#include "rendering/models/seeing/cloth_steps.h"

namespace rendering::models {

namespace {

/// Copy of the weights with the distances of heights only, or of friction only.
LossWeights heightsOnly(LossWeights weights)
{
    weights.mean = weights.logRatio = 0;
    return weights;
}
LossWeights meansOnly(LossWeights weights)
{
    weights.pixel = weights.logRatio = 0;
    return weights;
}
LossWeights spectrogramsOnly(LossWeights weights)
{
    weights.pixel = weights.mean = 0;
    return weights;
}

class PaperObjective : public ClothObjective {
public:
    PaperObjective(Objective objective, const Architecture& architecture)
        : m_objective(objective),
          m_weights(weightsFor(objective)),
          m_scales{architecture.meanFrictionScale, 1},
          m_discriminator(architecture, m_weights.adversary)
    {
    }

    std::string name() const override { return nameOf(m_objective); }

    Losses of(const ClothTensors& batch, const torch::Tensor& relief, const SeenFriction& friction, double learningRate) override
    {
        const auto centred = [](const torch::Tensor& maps) { return maps - maps.mean({2, 3}, true); };
        const BatchSignals generated{centred(relief), {}, {friction.logRatio, friction.logMean.exp()}};
        const BatchSignals known{
            centred(batch.reliefs), {}, {batch.logRatios.view_as(friction.logRatio), batch.logFrictions.exp()}};
        const auto distanceBy = [&](const LossWeights& weights) { return distance(generated, known, weights, m_scales); };
        Losses losses{distanceBy(heightsOnly(m_weights)), distanceBy(meansOnly(m_weights)),
                      distanceBy(spectrogramsOnly(m_weights))};
        if (m_weights.adversarial > 0) {
            m_discriminator.step(batch.photographs, known, generated, learningRate);
            losses.relief = losses.relief + m_weights.adversarial * m_discriminator.lossOf(batch.photographs, generated);
        }
        return losses;
    }

    std::vector<StoredTensor> tensors() override
    {
        if (m_weights.adversarial == 0) return {};
        std::vector<StoredTensor> all;
        for (const NamedTensor& one : m_discriminator.networkTensors()) all.push_back(storedTensor(one.name, one.tensor));
        for (StoredTensor& one : momentsOf("discriminator_steps.", m_discriminator.optimiser())) all.push_back(std::move(one));
        return all;
    }

    void continueFrom(const std::vector<StoredTensor>& tensors, std::size_t& next) override
    {
        if (m_weights.adversarial == 0) return;
        const torch::NoGradGuard noGradient;
        for (NamedTensor& one : m_discriminator.networkTensors()) copyInto(one.tensor, tensors.at(next++));
        setMoments(m_discriminator.optimiser(), tensors, next);
    }

private:
    Objective m_objective;
    LossWeights m_weights;
    DistanceScales m_scales;
    DiscriminatorTraining m_discriminator;
};

}  // namespace

decltype(ClothTrainingOptions::makeObjective) paperObjective(Objective objective)
{
    if (objective == Objective::Default) return {};
    return [objective](const Architecture& architecture) -> std::unique_ptr<ClothObjective> {
        return std::make_unique<PaperObjective>(objective, architecture);
    };
}

}  // namespace rendering::models
