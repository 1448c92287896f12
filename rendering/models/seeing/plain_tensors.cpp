#include "rendering/models/seeing/plain_tensors.h"

#include <cassert>
#include <cstring>
#include <memory>
#include <utility>

namespace rendering::models {

namespace {

constexpr std::pair<Element, torch::ScalarType> elementTypes[] = {
    {Element::F16, torch::kHalf}, {Element::F32, torch::kFloat}, {Element::I64, torch::kLong}};

Element elementFor(torch::ScalarType wanted)
{
    for (const auto& [element, type] : elementTypes)
        if (type == wanted) return element;
    assert(false && "the networks hold half, single and 64-bit integer numbers only");
    return Element::F32;
}

torch::ScalarType typeFor(Element wanted)
{
    for (const auto& [element, type] : elementTypes)
        if (element == wanted) return type;
    return torch::kFloat;
}

/// The state of a parameter, or null before its first step.
torch::optim::AdamParamState* momentsFor(torch::optim::Adam& optimiser, const torch::Tensor& parameter)
{
    const auto found = optimiser.state().find(c10::guts::to_string(parameter.unsafeGetTensorImpl()));
    return found == optimiser.state().end() ? nullptr : static_cast<torch::optim::AdamParamState*>(found->second.get());
}

torch::Tensor numberTensor(std::int64_t number) { return torch::tensor(number, torch::kLong); }

template <class Visit>
void eachOptimisedParameter(torch::optim::Adam& optimiser, Visit visit)
{
    for (torch::optim::OptimizerParamGroup& group : optimiser.param_groups())
        for (torch::Tensor& parameter : group.params()) visit(parameter);
}

}  // namespace

std::vector<NamedTensor> tensorsOfModule(const std::string& prefix, const torch::nn::Module& module)
{
    std::vector<NamedTensor> all;
    for (const auto& item : module.named_parameters()) all.push_back({prefix + item.key(), item.value(), true});
    for (const auto& item : module.named_buffers()) all.push_back({prefix + item.key(), item.value(), false});
    return all;
}

TensorKind kindOf(const std::string& name, const torch::Tensor& tensor)
{
    return {name, elementFor(tensor.scalar_type()), tensor.sizes().vec()};
}

StoredTensor storedTensor(const std::string& name, const torch::Tensor& tensor)
{
    const torch::Tensor whole = tensor.detach().contiguous();
    StoredTensor stored{kindOf(name, whole), {}};
    stored.bytes.assign(static_cast<const char*>(whole.data_ptr()), byteCount(stored.kind));
    return stored;
}

void copyInto(torch::Tensor& to, const StoredTensor& from)
{
    const torch::NoGradGuard noGradient;
    const torch::Tensor plain = torch::empty(from.kind.shape, torch::TensorOptions(typeFor(from.kind.element)));
    std::memcpy(plain.data_ptr(), from.bytes.data(), from.bytes.size());
    to.copy_(plain);
}

std::vector<TensorKind> kindsOf(const std::vector<StoredTensor>& tensors)
{
    std::vector<TensorKind> kinds;
    for (const StoredTensor& tensor : tensors) kinds.push_back(tensor.kind);
    return kinds;
}

std::vector<StoredTensor> momentsOf(const std::string& prefix, torch::optim::Adam& optimiser)
{
    std::vector<StoredTensor> all;
    eachOptimisedParameter(optimiser, [&](torch::Tensor& parameter) {
        const torch::optim::AdamParamState* state = momentsFor(optimiser, parameter);
        const std::string name = prefix + std::to_string(all.size() / 3);
        const torch::Tensor none = torch::zeros_like(parameter);
        all.push_back(storedTensor(name + ".first_moment", state ? state->exp_avg() : none));
        all.push_back(storedTensor(name + ".second_moment", state ? state->exp_avg_sq() : none));
        all.push_back(storedTensor(name + ".steps", numberTensor(state ? state->step() : 0)));
    });
    return all;
}

void setMoments(torch::optim::Adam& optimiser, const std::vector<StoredTensor>& tensors, std::size_t& next)
{
    eachOptimisedParameter(optimiser, [&](torch::Tensor& parameter) {
        torch::Tensor first = torch::empty_like(parameter).detach(), second = torch::empty_like(parameter).detach();
        torch::Tensor steps = numberTensor(0);
        copyInto(first, tensors.at(next++));
        copyInto(second, tensors.at(next++));
        copyInto(steps, tensors.at(next++));
        if (steps.item<std::int64_t>() <= 0) return;
        auto state = std::make_unique<torch::optim::AdamParamState>();
        state->step(steps.item<std::int64_t>());
        state->exp_avg(first);
        state->exp_avg_sq(second);
        optimiser.state()[c10::guts::to_string(parameter.unsafeGetTensorImpl())] = std::move(state);
    });
}

void orderChannelsLast(torch::nn::Module& module)
{
    const torch::NoGradGuard noGradient;
    for (torch::Tensor& parameter : module.parameters())
        if (parameter.dim() == 4) parameter.set_data(parameter.contiguous(torch::MemoryFormat::ChannelsLast));
}

}  // namespace rendering::models
