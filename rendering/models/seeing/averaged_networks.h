// Networks in training: their optimiser and the moving average of their weights, which is the result.
// Only the torch sources include it.
#pragma once

#include "rendering/models/seeing/seeing_weights.h"

namespace rendering::models {

class TrainingPeers;

class AveragedNetworks {
public:
    explicit AveragedNetworks(const Architecture& architecture);

    /// Starts from trained networks instead of new ones.
    void startFrom(SeeingNetworks& networks);

    SeeingNetworks& now() { return m_networks; }
    SeeingNetworks& average() { return m_average; }

    /// Moves against the gradient of `loss`, each network's gradient limited. `number`: steps before this one; the average
    /// follows faster during the first ones, because the early networks are still poor.
    void step(const torch::Tensor& loss, double learningRate, int number);

    /// From now on `loss` is this process's part of a loss that all processes sum. All of them take the same steps. `peers` must
    /// outlive this object.
    void shareWith(const TrainingPeers& peers);

    bool finite();

    /// Networks, average and optimiser, always the same tensors in the same order.
    std::vector<StoredTensor> tensors();
    /// Takes them from `tensors`, beginning at `next`, which moves behind them.
    void continueFrom(const std::vector<StoredTensor>& tensors, std::size_t& next);

private:
    SeeingNetworks m_networks, m_average;
    torch::optim::Adam m_steps;
    const TrainingPeers* m_peers = nullptr;
};

/// Learning rate after `fraction` of the training: it rises over `warmUpSteps` and falls to a fiftieth along a cosine.
double learningRateAt(double highest, double fraction, int step, int warmUpSteps);

}  // namespace rendering::models
