#include "rendering/models/networks/weights.h"

#include <utility>

#include "rendering/models/seeing/plain_tensors.h"
#include "rendering/models/seeing/seeing_weights.h"

namespace rendering::models {

namespace {

std::vector<NamedTensor> tensorsOf(const Generators& generators)
{
    std::vector<NamedTensor> all = tensorsOfModule("height.", *generators.height);
    for (NamedTensor& one : tensorsOfModule("friction.", *generators.friction)) all.push_back(std::move(one));
    return all;
}

/// The tensors of a weights file: parameters in half precision.
std::vector<TensorKind> wantedTensors(const std::vector<NamedTensor>& tensors)
{
    std::vector<TensorKind> wanted;
    for (const NamedTensor& one : tensors) {
        wanted.push_back(kindOf(one.name, one.tensor));
        if (one.parameter) wanted.back().element = Element::F16;
    }
    return wanted;
}

}  // namespace

std::vector<torch::Tensor> parametersOf(const Generators& generators)
{
    std::vector<torch::Tensor> all = generators.height->parameters();
    for (const torch::Tensor& parameter : generators.friction->parameters()) all.push_back(parameter);
    return all;
}

Generators makeGenerators(const Architecture& architecture)
{
    Generators generators{HeightGenerator(architecture), FrictionGenerator(architecture)};
    orderChannelsLast(*generators.height);
    orderChannelsLast(*generators.friction);
    return generators;
}

void roundToHalf(Generators& generators)
{
    const torch::NoGradGuard noGradient;
    for (NamedTensor& one : tensorsOf(generators))
        if (one.parameter) one.tensor.copy_(one.tensor.to(torch::kHalf).to(torch::kFloat));
}

void writeModel(const std::filesystem::path& model, Generators& generators, ModelCardFields card)
{
    writeTensorsWithCard(model, tensorsOf(generators), std::move(card));
}

Generators readModel(const std::filesystem::path& model, const ModelCardFields& card)
{
    Generators generators = makeGenerators(card.architecture);
    std::vector<NamedTensor> tensors = tensorsOf(generators);
    const std::vector<TensorKind> wanted = wantedTensors(tensors);
    const TensorSource source = weightsSource(model);
    const std::string bytes = readTensorBytes(wanted, source);
    requireHashOfCard(model, bytes, card);
    const TensorFile file = parseTensorFile(bytes, wanted, source);
    for (std::size_t i = 0; i < tensors.size(); ++i) copyInto(tensors[i].tensor, file.tensors[i]);
    generators.height->eval();
    generators.friction->eval();
    return generators;
}

}  // namespace rendering::models
