#include "rendering/models/seeing/ring_tensors.h"

#include <map>
#include <mutex>
#include <opencv2/core.hpp>

#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

namespace {

/// [frequencies of rfft2, rings]. The transform of a real map leaves out half of the columns, so the others count twice.
torch::Tensor makeAverages(int side)
{
    cv::Mat rows = ringAverages(side, side);
    const torch::Tensor whole = torch::from_blob(rows.data, {ringCount, side, side});
    torch::Tensor half = whole.narrow(2, 0, side / 2 + 1).clone();
    half.narrow(2, 1, side / 2 - 1).mul_(2);
    return half.flatten(1).t().contiguous();
}

/// Averages for one side, made at the first call.
torch::Tensor averagesOf(int side)
{
    static std::mutex guard;
    static std::map<int, torch::Tensor> made;
    const std::lock_guard<std::mutex> lock(guard);
    const auto found = made.find(side);
    return found != made.end() ? found->second : made.emplace(side, makeAverages(side)).first->second;
}

}  // namespace

torch::Tensor powers(const torch::Tensor& maps)
{
    const auto side = maps.size(3);
    TORCH_CHECK(maps.dim() == 4 && maps.size(1) == 1 && maps.size(2) == side, "expected square maps with one channel");
    const torch::Tensor line = torch::hann_window(side);
    const torch::Tensor window = line.view({-1, 1}) * line;
    const torch::Tensor mean = (maps * window).sum({2, 3}, true) / window.sum();
    const torch::Tensor transform = torch::fft::rfft2(((maps - mean) * window).squeeze(1));
    return (torch::real(transform).square() + torch::imag(transform).square()) / window.square().sum();
}

torch::Tensor ringMeans(const torch::Tensor& maps)
{
    return torch::matmul(powers(maps).flatten(1), averagesOf(static_cast<int>(maps.size(3))));
}

}  // namespace rendering::models
