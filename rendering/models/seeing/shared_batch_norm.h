// Batch normalisation over the whole batch of a training in several processes, of which each holds a part. Alone it is torch's.
// Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

namespace rendering::models {

class TrainingPeers;

/// Has the parameters and buffers of torch::nn::BatchNorm2d, under the same names. It cannot derive from it, because libtorch
/// does not export all that the table of a derived class needs.
class SharedBatchNormImpl : public torch::nn::NormImplBase<2, SharedBatchNormImpl, torch::nn::BatchNormOptions> {
public:
    explicit SharedBatchNormImpl(std::int64_t channels) : NormImplBase(torch::nn::BatchNormOptions(channels)) {}

    /// Mean and variance of training batches are those of all processes from now on. `peers` must outlive the module, or be null.
    void shareWith(const TrainingPeers* peers) { m_peers = peers; }

    torch::Tensor forward(const torch::Tensor& features);

    /// Moves the normalisation by the running statistics into `before`, whose output it normalises. Afterwards forward() does
    /// nothing.
    void foldInto(torch::nn::Conv2dImpl& before);

private:
    void _check_input_dim(const torch::Tensor& features) override;

    const TrainingPeers* m_peers = nullptr;
    bool m_isFolded = false;
};
TORCH_MODULE(SharedBatchNorm);

/// shareWith() for every such normalisation of a module.
void shareBatchNorms(torch::nn::Module& module, const TrainingPeers* peers);

/// Makes a trained network fast to use: each normalisation is folded into the convolution before it, and the rectifier behind
/// it works in place. Outputs change by rounding only. Such a network can neither be trained nor written any more.
void foldBatchNorms(torch::nn::Module& module);

}  // namespace rendering::models
