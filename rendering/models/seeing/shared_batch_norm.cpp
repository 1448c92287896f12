#include "rendering/models/seeing/shared_batch_norm.h"

#include "rendering/models/seeing/training_peers.h"

namespace rendering::models {

namespace {

namespace autograd = torch::autograd;
using torch::Tensor;

/// Numbers of the channels [C] as a factor of features [N, C, H, W].
Tensor ofChannels(const Tensor& numbers) { return numbers.view({1, -1, 1, 1}); }

/// Mean and biased variance of every channel over the batches of all processes, in double precision.
struct SharedMoments {
    Tensor mean, variance;
    double count = 0;
};

SharedMoments sharedMoments(const Tensor& features, const TrainingPeers& peers)
{
    const std::int64_t channels = features.size(1);
    const double own = static_cast<double>(features.numel()) / static_cast<double>(channels);
    const auto [variance, mean] = torch::var_mean(features, {0, 2, 3}, false);
    const Tensor ownMean = mean.to(torch::kDouble);
    Tensor sums = torch::cat(
        {own * ownMean, own * (variance.to(torch::kDouble) + ownMean.square()), torch::full({1}, own, torch::kDouble)});
    peers.sum(sums);
    const double count = sums[2 * channels].item<double>();
    const Tensor shared = sums.narrow(0, 0, channels) / count;
    return {shared, (sums.narrow(0, channels, channels) / count - shared.square()).clamp_min(0), count};
}

/// The features with mean 0 and variance 1 over the whole batch. Its gradient needs two sums over all processes.
struct Standardised : autograd::Function<Standardised> {
    static Tensor forward(autograd::AutogradContext* context, const Tensor& features, const Tensor& mean, const Tensor& scale,
                          double count, const TrainingPeers* peers)
    {
        const Tensor result = (features - ofChannels(mean)) * ofChannels(scale);
        context->save_for_backward({result, scale});
        context->saved_data["count"] = count;
        context->saved_data["peers"] = reinterpret_cast<std::int64_t>(peers);
        return result;
    }

    static autograd::tensor_list backward(autograd::AutogradContext* context, const autograd::tensor_list& gradients)
    {
        const auto saved = context->get_saved_variables();
        const Tensor &result = saved[0], &scale = saved[1], &gradient = gradients[0];
        const std::int64_t channels = scale.size(0);
        Tensor sums = torch::cat({gradient.sum({0, 2, 3}), (gradient * result).sum({0, 2, 3})}).to(torch::kDouble);
        reinterpret_cast<const TrainingPeers*>(context->saved_data["peers"].toInt())->sum(sums);
        const Tensor means = (sums / context->saved_data["count"].toDouble()).to(torch::kFloat);
        const Tensor ofFeatures = ofChannels(scale) * (gradient - ofChannels(means.narrow(0, 0, channels)) -
                                                       result * ofChannels(means.narrow(0, channels, channels)));
        return {ofFeatures, Tensor(), Tensor(), Tensor(), Tensor()};
    }
};

}  // namespace

Tensor SharedBatchNormImpl::forward(const Tensor& features)
{
    if (m_isFolded) return features;
    if (m_peers == nullptr || !is_training()) {
        if (is_training()) num_batches_tracked += 1;
        return torch::batch_norm(features, weight, bias, running_mean, running_var, is_training(), *options.momentum(),
                                 options.eps(), false);
    }
    const SharedMoments moments = sharedMoments(features.detach(), *m_peers);
    {
        const torch::NoGradGuard noGradient;
        const double share = *options.momentum();
        num_batches_tracked += 1;
        running_mean.mul_(1 - share).add_(share * moments.mean.to(torch::kFloat));
        running_var.mul_(1 - share).add_(share * (moments.variance * (moments.count / (moments.count - 1))).to(torch::kFloat));
    }
    const Tensor scale = (moments.variance + options.eps()).rsqrt().to(torch::kFloat);
    const Tensor standardised = Standardised::apply(features, moments.mean.to(torch::kFloat), scale, moments.count, m_peers);
    return standardised * ofChannels(weight) + ofChannels(bias);
}

void SharedBatchNormImpl::foldInto(torch::nn::Conv2dImpl& before)
{
    TORCH_CHECK(!is_training() && !m_isFolded && !before.bias.defined(), "expected a trained network that is not folded");
    const torch::NoGradGuard noGradient;
    const Tensor scale = weight * (running_var + options.eps()).rsqrt();
    before.weight.mul_(scale.view({-1, 1, 1, 1}));
    before.bias = bias - running_mean * scale;
    m_isFolded = true;
}

void SharedBatchNormImpl::_check_input_dim(const Tensor& features)
{
    TORCH_CHECK(features.dim() == 4, "expected features [N, C, H, W]");
}

void shareBatchNorms(torch::nn::Module& module, const TrainingPeers* peers)
{
    for (const auto& part : module.modules())
        if (auto* norm = part->as<SharedBatchNormImpl>()) norm->shareWith(peers);
}

void foldBatchNorms(torch::nn::Module& module)
{
    for (const auto& part : module.modules()) {
        auto* chain = part->as<torch::nn::SequentialImpl>();
        if (chain == nullptr) continue;
        for (std::size_t i = 1; i < chain->size(); ++i) {
            auto* norm = chain->ptr(i)->as<SharedBatchNormImpl>();
            if (norm == nullptr) continue;
            auto* convolution = chain->ptr(i - 1)->as<torch::nn::Conv2dImpl>();
            TORCH_CHECK(convolution != nullptr, "expected a convolution before each normalisation");
            norm->foldInto(*convolution);
            if (i + 1 == chain->size()) continue;
            if (auto* rectifier = chain->ptr(i + 1)->as<torch::nn::LeakyReLUImpl>()) rectifier->options.inplace(true);
        }
    }
}

}  // namespace rendering::models
