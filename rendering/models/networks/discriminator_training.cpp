#include "rendering/models/networks/discriminator_training.h"

namespace rendering::models {

namespace {

constexpr double discriminatorRateShare = 0.5;

void requireGradients(torch::nn::Module& module, bool wanted)
{
    for (torch::Tensor& parameter : module.parameters()) parameter.set_requires_grad(wanted);
}

}  // namespace

DiscriminatorTraining::DiscriminatorTraining(const Architecture& architecture, Adversary adversary)
    : m_adversary(adversary),
      m_network(architecture, adversary == Adversary::Hinge),
      m_steps(adversarialAdam(m_network->parameters()))
{
    orderChannelsLast(*m_network);
}

double DiscriminatorTraining::step(const torch::Tensor& photograph, const BatchSignals& measured, const BatchSignals& generated,
                                   double learningRate)
{
    setLearningRate(m_steps, discriminatorRateShare * learningRate);
    m_steps.zero_grad();
    const torch::Tensor real = m_network->forward(photograph, measured.friction, measured.height);
    const FrictionOutput generatedFriction{generated.friction.logRatio.detach(), generated.friction.mean.detach()};
    const torch::Tensor fake = m_network->forward(photograph, generatedFriction, generated.height.detach());
    const torch::Tensor loss = discriminatorLoss(real, fake, m_adversary);
    loss.backward();
    m_steps.step();
    return loss.item<double>();
}

torch::Tensor DiscriminatorTraining::lossOf(const torch::Tensor& photograph, const BatchSignals& generated)
{
    requireGradients(*m_network, false);
    const torch::Tensor logits = m_network->forward(photograph, generated.friction, generated.height);
    requireGradients(*m_network, true);
    return adversarialLoss(logits, m_adversary);
}

torch::optim::Adam adversarialAdam(std::vector<torch::Tensor> parameters)
{
    return torch::optim::Adam(std::move(parameters), torch::optim::AdamOptions().betas(std::make_tuple(0.5, 0.999)));
}

void setLearningRate(torch::optim::Adam& optimiser, double rate)
{
    for (torch::optim::OptimizerParamGroup& group : optimiser.param_groups())
        static_cast<torch::optim::AdamOptions&>(group.options()).lr(rate);
}

}  // namespace rendering::models
