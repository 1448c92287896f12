// The discriminator in training, with its optimiser. Only the torch sources of this folder include it.
#pragma once

#include "rendering/models/networks/losses.h"
#include "rendering/models/seeing/plain_tensors.h"

namespace rendering::models {

class DiscriminatorTraining {
public:
    DiscriminatorTraining(const Architecture& architecture, Adversary adversary);

    /// Eq. 1: one step; no gradient reaches the generators. `learningRate`: that of the generators; the discriminator's is half
    /// of it, because at equal rates it wins immediately. Returns the loss.
    double step(const torch::Tensor& photograph, const BatchSignals& measured, const BatchSignals& generated,
                double learningRate);

    /// Eq. 2: loss of the generators before the present discriminator, which gets no gradient.
    torch::Tensor lossOf(const torch::Tensor& photograph, const BatchSignals& generated);

    std::vector<NamedTensor> networkTensors() const { return tensorsOfModule("discriminator.", *m_network); }
    torch::optim::Adam& optimiser() { return m_steps; }

private:
    Adversary m_adversary;
    Discriminator m_network;
    torch::optim::Adam m_steps;
};

/// Adam as all networks of the paper use it.
torch::optim::Adam adversarialAdam(std::vector<torch::Tensor> parameters);
void setLearningRate(torch::optim::Adam& optimiser, double rate);

}  // namespace rendering::models
