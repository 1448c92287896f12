#include "rendering/models/seeing/seeing_weights.h"

#include <utility>

#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"

namespace rendering::models {

SeeingNetworks makeSeeingNetworks(const Architecture& architecture)
{
    SeeingNetworks networks{ReliefNetwork(architecture), FrictionNetwork(architecture)};
    orderChannelsLast(*networks.relief);
    orderChannelsLast(*networks.friction);
    return networks;
}

std::vector<NamedTensor> tensorsOf(const std::string& prefix, SeeingNetworks& networks)
{
    std::vector<NamedTensor> all = tensorsOfModule(prefix + "relief.", *networks.relief);
    for (NamedTensor& one : tensorsOfModule(prefix + "friction.", *networks.friction)) all.push_back(std::move(one));
    return all;
}

std::vector<torch::Tensor> parametersOf(SeeingNetworks& networks)
{
    std::vector<torch::Tensor> all = networks.relief->parameters();
    for (const torch::Tensor& parameter : networks.friction->parameters()) all.push_back(parameter);
    return all;
}

void setTraining(SeeingNetworks& networks, bool on)
{
    networks.relief->train(on);
    networks.friction->train(on);
}

void moveTowards(SeeingNetworks& to, SeeingNetworks& from, double share)
{
    if (share <= 0) return;
    const torch::NoGradGuard noGradient;
    std::vector<NamedTensor> targets = tensorsOf({}, to);
    const std::vector<NamedTensor> sources = tensorsOf({}, from);
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (share >= 1 || !targets[i].tensor.is_floating_point())
            targets[i].tensor.copy_(sources[i].tensor);
        else
            targets[i].tensor.lerp_(sources[i].tensor, share);
    }
}

void writeTensorsWithCard(const std::filesystem::path& model, const std::vector<NamedTensor>& tensors, ModelCardFields card)
{
    TensorFile file{{{"format", "vis2hap.weights/1"}}, {}};
    for (const NamedTensor& one : tensors)
        file.tensors.push_back(storedTensor(one.name, one.parameter ? one.tensor.to(torch::kHalf) : one.tensor));
    const std::string bytes = tensorFileBytes(file);
    protocols::writeWholeFile(model, bytes);
    card.summary.sha256 = protocols::sha256(bytes);
    protocols::writeWholeFile(cardOf(model), cardText(card));
}

void writeSeeingModel(const std::filesystem::path& model, SeeingNetworks& networks, ModelCardFields card)
{
    writeTensorsWithCard(model, tensorsOf({}, networks), std::move(card));
}

SeeingNetworks readSeeingModel(const std::filesystem::path& model, const ModelCardFields& card)
{
    SeeingNetworks networks = makeSeeingNetworks(card.architecture);
    std::vector<NamedTensor> tensors = tensorsOf({}, networks);
    std::vector<TensorKind> wanted;
    for (const NamedTensor& one : tensors) {
        wanted.push_back(kindOf(one.name, one.tensor));
        if (one.parameter) wanted.back().element = Element::F16;
    }
    const TensorSource source = weightsSource(model);
    const std::string bytes = readTensorBytes(wanted, source);
    requireHashOfCard(model, bytes, card);
    const TensorFile file = parseTensorFile(bytes, wanted, source);
    const torch::NoGradGuard noGradient;
    for (std::size_t i = 0; i < tensors.size(); ++i) copyInto(tensors[i].tensor, file.tensors[i]);
    setTraining(networks, false);
    return networks;
}

}  // namespace rendering::models
