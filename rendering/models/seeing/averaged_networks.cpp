#include "rendering/models/seeing/averaged_networks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/models/seeing/shared_batch_norm.h"
#include "rendering/models/seeing/training_peers.h"

namespace rendering::models {

namespace {

/// Decay of the moving average of the weights: the share of the average that remains after each step.
constexpr double averageDecay = 0.998;
constexpr double largestGradient = 1;

/// Sums the gradients over all processes, as one row of numbers.
void sumGradients(const std::vector<torch::Tensor>& parameters, const TrainingPeers& peers)
{
    std::vector<torch::Tensor> flat;
    for (const torch::Tensor& one : parameters) flat.push_back(one.grad().reshape({-1}));
    torch::Tensor all = torch::cat(flat);
    peers.sum(all);
    std::int64_t next = 0;
    for (const torch::Tensor& one : parameters) {
        one.grad().copy_(all.narrow(0, next, one.numel()).view_as(one.grad()));
        next += one.numel();
    }
}

}  // namespace

AveragedNetworks::AveragedNetworks(const Architecture& architecture)
    : m_networks(makeSeeingNetworks(architecture)),
      m_average(makeSeeingNetworks(architecture)),
      m_steps(parametersOf(m_networks), torch::optim::AdamOptions())
{
    moveTowards(m_average, m_networks, 1);
}

void AveragedNetworks::startFrom(SeeingNetworks& networks)
{
    moveTowards(m_networks, networks, 1);
    moveTowards(m_average, networks, 1);
}

void AveragedNetworks::step(const torch::Tensor& loss, double learningRate, int number)
{
    for (torch::optim::OptimizerParamGroup& group : m_steps.param_groups())
        static_cast<torch::optim::AdamOptions&>(group.options()).lr(learningRate);
    m_steps.zero_grad();
    loss.backward();
    if (m_peers != nullptr) sumGradients(parametersOf(m_networks), *m_peers);
    torch::nn::utils::clip_grad_norm_(m_networks.relief->parameters(), largestGradient);
    torch::nn::utils::clip_grad_norm_(m_networks.friction->parameters(), largestGradient);
    m_steps.step();
    moveTowards(m_average, m_networks, 1 - std::min(averageDecay, (number + 1.0) / (number + 10.0)));
}

void AveragedNetworks::shareWith(const TrainingPeers& peers)
{
    m_peers = &peers;
    shareBatchNorms(*m_networks.relief, &peers);
    shareBatchNorms(*m_networks.friction, &peers);
}

bool AveragedNetworks::finite()
{
    const std::vector<torch::Tensor> parameters = parametersOf(m_networks);
    return std::all_of(parameters.begin(), parameters.end(),
                       [](const torch::Tensor& one) { return torch::isfinite(one).all().item<bool>(); });
}

std::vector<StoredTensor> AveragedNetworks::tensors()
{
    std::vector<StoredTensor> all;
    for (const auto& [prefix, networks] : {std::pair{"now.", &m_networks}, {"average.", &m_average}})
        for (const NamedTensor& one : tensorsOf(prefix, *networks)) all.push_back(storedTensor(one.name, one.tensor));
    for (StoredTensor& one : momentsOf("steps.", m_steps)) all.push_back(std::move(one));
    return all;
}

void AveragedNetworks::continueFrom(const std::vector<StoredTensor>& tensors, std::size_t& next)
{
    const torch::NoGradGuard noGradient;
    for (SeeingNetworks* networks : {&m_networks, &m_average})
        for (NamedTensor& one : tensorsOf({}, *networks)) copyInto(one.tensor, tensors.at(next++));
    setMoments(m_steps, tensors, next);
}

double learningRateAt(double highest, double fraction, int step, int warmUpSteps)
{
    const double fall = 0.02 + 0.98 * 0.5 * (1 + std::cos(std::numbers::pi * fraction));
    return highest * fall * std::min(1.0, (step + 1.0) / warmUpSteps);
}

}  // namespace rendering::models
