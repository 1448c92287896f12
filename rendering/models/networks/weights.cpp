#include "rendering/models/networks/weights.h"

#include <optional>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"

namespace rendering::models {

namespace {

protocols::Error notAModel(const std::filesystem::path& model, const std::string& why)
{
    return protocols::badInput({"is not a weights file of this program: " + why, model.string(),
                                "a weights file from `vis2hap train`", "train again or use the weights of the program"});
}

/// First line of a torch message, which ends with a stack trace.
std::string firstLine(const std::string& message) { return message.substr(0, message.find('\n')); }

template <class Visit>
void eachTensor(Generators& generators, Visit visit)
{
    const auto visitAll = [&](const std::string& prefix, torch::nn::Module& module) {
        for (auto& item : module.named_parameters()) visit(prefix + item.key(), item.value(), true);
        for (auto& item : module.named_buffers()) visit(prefix + item.key(), item.value(), false);
    };
    visitAll("height.", *generators.height);
    visitAll("friction.", *generators.friction);
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
    eachTensor(generators, [](const std::string&, torch::Tensor& tensor, bool parameter) {
        if (parameter) tensor.copy_(tensor.to(torch::kHalf).to(torch::kFloat));
    });
}

void writeArchive(const std::filesystem::path& file, torch::serialize::OutputArchive& archive)
{
    std::ostringstream stream;
    archive.save_to(stream);
    protocols::writeWholeFile(file, stream.str());
}

torch::serialize::InputArchive readArchive(const std::filesystem::path& file)
{
    const std::optional<std::string> bytes = protocols::readIfPossible(file);
    if (!bytes) throw notAModel(file, "it cannot be read");
    torch::serialize::InputArchive archive;
    try {
        archive.load_from(bytes->data(), bytes->size());
    } catch (const std::exception& fault) {
        throw notAModel(file, firstLine(fault.what()));
    }
    return archive;
}

void writeModel(const std::filesystem::path& model, Generators& generators, ModelCardFields card)
{
    torch::serialize::OutputArchive archive;
    eachTensor(generators, [&](const std::string& name, torch::Tensor& tensor, bool parameter) {
        archive.write(name, parameter ? tensor.detach().to(torch::kHalf) : tensor.detach());
    });
    writeArchive(model, archive);
    card.summary.sha256 = protocols::sha256OfFile(model);
    protocols::writeWholeFile(cardOf(model), cardText(card));
}

Generators readModel(const std::filesystem::path& model, const ModelCardFields& card)
{
    checkWeightsFile(model, card);
    torch::serialize::InputArchive archive = readArchive(model);
    Generators generators = makeGenerators(card.architecture);
    const torch::NoGradGuard noGradient;
    eachTensor(generators, [&](const std::string& name, torch::Tensor& tensor, bool) {
        torch::Tensor stored;
        if (!archive.try_read(name, stored) || stored.sizes() != tensor.sizes())
            throw notAModel(model, "the tensor " + name + " is missing or has another shape");
        if (stored.is_floating_point() && !torch::isfinite(stored.to(torch::kFloat)).all().item<bool>())
            throw notAModel(model, "the tensor " + name + " holds numbers that are not finite");
        tensor.copy_(stored.to(tensor.scalar_type()));
    });
    generators.height->eval();
    generators.friction->eval();
    return generators;
}

}  // namespace rendering::models
