// Torch tensors to and from the plain tensors of tensor_file.h. Torch itself reads and writes no file in this program.
// Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

#include <string>
#include <vector>

#include "rendering/models/tensors/tensor_file.h"

namespace rendering::models {

/// A tensor of a module; it shares its numbers with the module.
struct NamedTensor {
    std::string name;
    torch::Tensor tensor;
    bool parameter = false;  ///< else a running statistic
};

/// Parameters, then running statistics, with `prefix` before their names.
std::vector<NamedTensor> tensorsOfModule(const std::string& prefix, const torch::nn::Module& module);

/// Name, kind of numbers and shape. The numbers must be half, single or 64-bit integer.
TensorKind kindOf(const std::string& name, const torch::Tensor& tensor);
StoredTensor storedTensor(const std::string& name, const torch::Tensor& tensor);

/// Copies the numbers into a tensor of the same shape, which keeps its own kind of numbers and memory order.
void copyInto(torch::Tensor& to, const StoredTensor& from);

/// Stores the weights of convolutions in the memory order channels-last, in which they run about twice as fast on CPUs.
void orderChannelsLast(torch::nn::Module& module);

std::vector<TensorKind> kindsOf(const std::vector<StoredTensor>& tensors);

/// Both moments and the number of steps of every parameter of an optimiser; zeros where it has not yet moved the parameter.
std::vector<StoredTensor> momentsOf(const std::string& prefix, torch::optim::Adam& optimiser);

/// Takes the moments from `tensors`, in the order of momentsOf(), beginning at `next`, which moves behind them.
void setMoments(torch::optim::Adam& optimiser, const std::vector<StoredTensor>& tensors, std::size_t& next);

}  // namespace rendering::models
