#include "rendering/models/networks/peer_step.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <thread>
#include <vector>

#include "protocols/files/whole_file.h"
#include "rendering/models/networks/weights.h"
#include "rendering/models/ring_spectrum.h"
#include "rendering/models/seeing/plain_tensors.h"

namespace rendering::models {

namespace {

constexpr int batchSize = 8;

/// The networks with their optimisers and a batch.
class PeerStep {
public:
    PeerStep();
    void write(const std::filesystem::path& file);
    void train();
    void infer();
    std::string losses() const { return std::to_string(m_discriminatorLoss) + " " + std::to_string(m_generatorLoss); }
    std::string sizes() const;

private:
    torch::Tensor discriminatorLoss(const FrictionOutput& friction, const torch::Tensor& height);
    torch::Tensor generatorLoss(const FrictionOutput& friction, const torch::Tensor& height);
    void setTraining(bool training);

    Architecture m_architecture;
    Generators m_generators;
    Discriminator m_discriminator;
    torch::optim::Adam m_generatorSteps, m_discriminatorSteps;
    torch::Tensor m_photograph, m_height, m_rings;
    FrictionOutput m_friction;
    double m_discriminatorLoss = 0, m_generatorLoss = 0;
};

torch::optim::AdamOptions rates(double rate) { return torch::optim::AdamOptions(rate).betas(std::make_tuple(0.5, 0.999)); }

PeerStep::PeerStep()
    : m_generators(makeGenerators(m_architecture)),
      m_discriminator(m_architecture, true),
      m_generatorSteps(parametersOf(m_generators), rates(1e-3)),
      m_discriminatorSteps(m_discriminator->parameters(), rates(5e-4))
{
    orderChannelsLast(*m_discriminator);
    const int crop = m_architecture.crop;
    m_photograph = torch::rand({batchSize, 3, crop, crop});
    m_height = torch::rand({batchSize, 1, crop, crop});
    m_rings = torch::randn({batchSize, ringCount}) - 8;
    m_friction = {torch::randn({batchSize, 1, m_architecture.rows, m_architecture.frames}), torch::rand({batchSize, 1})};
}

std::string PeerStep::sizes() const
{
    std::string text;
    for (const int size : {m_architecture.baseChannels, m_architecture.rows, m_architecture.frames, ringCount})
        text += std::to_string(size) + " ";
    return text + std::to_string(m_architecture.meanFrictionScale);
}

void PeerStep::setTraining(bool training)
{
    m_generators.height->train(training);
    m_generators.friction->train(training);
    m_discriminator->train(training);
}

void PeerStep::write(const std::filesystem::path& file)
{
    TensorFile stored;
    const std::pair<const char*, const torch::nn::Module*> networks[] = {{"height.", m_generators.height.get()},
                                                                         {"friction.", m_generators.friction.get()},
                                                                         {"discriminator.", m_discriminator.get()}};
    for (const auto& [prefix, network] : networks)
        for (const NamedTensor& one : tensorsOfModule(prefix, *network))
            stored.tensors.push_back(storedTensor(one.name, one.tensor));
    const torch::NoGradGuard noGradient;
    setTraining(false);
    const FrictionOutput friction = m_generators.friction->forward(m_photograph);
    const torch::Tensor height = m_generators.height->forward(m_photograph);
    cv::Mat averages = ringAverages(m_architecture.crop, m_architecture.crop);
    const std::pair<const char*, torch::Tensor> named[] = {
        {"ring_averages", torch::from_blob(averages.data, {averages.rows, averages.cols})},
        {"photograph", m_photograph},
        {"target_height", m_height},
        {"target_rings", m_rings},
        {"target_ratio", m_friction.logRatio},
        {"target_mean", m_friction.mean},
        {"answer_height", height},
        {"answer_rings", m_generators.height->rings(m_photograph)},
        {"answer_ratio", friction.logRatio.contiguous()},
        {"answer_mean", friction.mean},
        {"answer_logits", m_discriminator->forward(m_photograph, friction, height)}};
    for (const auto& [name, tensor] : named) stored.tensors.push_back(storedTensor(name, tensor));
    protocols::writeWholeFile(file, tensorFileBytes(stored), protocols::Sync::Later);
}

torch::Tensor PeerStep::discriminatorLoss(const FrictionOutput& friction, const torch::Tensor& height)
{
    const torch::Tensor real = m_discriminator->forward(m_photograph, m_friction, m_height);
    const torch::Tensor made =
        m_discriminator->forward(m_photograph, {friction.logRatio.detach(), friction.mean.detach()}, height.detach());
    return torch::relu(1 - real).mean() + torch::relu(1 + made).mean();
}

torch::Tensor PeerStep::generatorLoss(const FrictionOutput& friction, const torch::Tensor& height)
{
    return -m_discriminator->forward(m_photograph, friction, height).mean() + (height - m_height).abs().mean() +
           (m_generators.height->rings(m_photograph) - m_rings).abs().mean() +
           (friction.logRatio - m_friction.logRatio).abs().mean() + (friction.mean - m_friction.mean).abs().mean();
}

void PeerStep::train()
{
    setTraining(true);
    const FrictionOutput friction = m_generators.friction->forward(m_photograph);
    const torch::Tensor height = m_generators.height->forward(m_photograph);
    m_discriminatorSteps.zero_grad();
    const torch::Tensor first = discriminatorLoss(friction, height);
    first.backward();
    m_discriminatorSteps.step();
    m_generatorSteps.zero_grad();
    const torch::Tensor second = generatorLoss(friction, height);
    second.backward();
    m_generatorSteps.step();
    m_discriminatorLoss = first.item<double>();
    m_generatorLoss = second.item<double>();
}

void PeerStep::infer()
{
    const torch::NoGradGuard noGradient;
    if (m_discriminator->is_training()) setTraining(false);
    const torch::Tensor one = m_photograph.narrow(0, 0, 1);
    m_generators.friction->forward(one);
    m_generators.height->forward(one);
}

double medianMs(int repeats, const std::function<void()>& work)
{
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) {
        const auto started = std::chrono::steady_clock::now();
        work();
        times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count());
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

}  // namespace

void servePeerSteps(const std::filesystem::path& folder, std::istream& in, std::ostream& out)
{
    torch::set_num_threads(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
    torch::manual_seed(1);
    PeerStep step;
    step.write(folder / "peer.safetensors");
    out << "ready " << step.sizes() << std::endl;
    for (std::string order; std::getline(in, order);) {
        if (order == "train")
            out << medianMs(1, [&] { step.train(); }) << std::endl;
        else if (order == "infer")
            out << medianMs(5, [&] { step.infer(); }) << std::endl;
        else if (order == "losses")
            out << step.losses() << std::endl;
        else
            break;
    }
}

}  // namespace rendering::models
