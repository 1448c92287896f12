#include "rendering/models/lab/lab_steps.h"

#include <algorithm>
#include <cmath>

#include "rendering/models/lab/lab_losses.h"
#include "rendering/models/seeing/cloth_tensors.h"
#include "rendering/models/seeing/relief_losses.h"
#include "rendering/models/seeing/seen_texture.h"

namespace rendering::models {

namespace {

constexpr int labWarmUpSteps = 20;

SeenFriction partOf(const SeenFriction& all, std::int64_t from, std::int64_t count)
{
    return {all.logMean.narrow(0, from, count), all.logSpread.narrow(0, from, count), all.logRatio.narrow(0, from, count)};
}

}  // namespace

LabSteps::LabSteps(const LabCloth& lab, const std::vector<ScannedCloth>& scans, const Architecture& architecture,
                   const ClothTrainingOptions& options)
    : m_lab(lab), m_scans(scans), m_architecture(architecture), m_options(options), m_trained(architecture)
{
}

LabSteps::HalvedBatch LabSteps::draw(int number) const
{
    ClothBatchOptions drawn;
    drawn.size = m_options.batch - m_options.batch / 2;
    drawn.side = m_options.side;
    drawn.scanShare = m_options.scanShare;
    drawn.spectrograms = m_architecture;
    LabBatchOptions lab;
    lab.size = m_options.batch / 2;
    lab.side = m_options.side;
    lab.logFrictionFactor = std::log(m_architecture.frictionFactor);
    lab.reliefFactor = m_architecture.reliefFactor;
    const auto at = static_cast<std::uint64_t>(number);
    return {drawClothBatch(m_scans, drawn, m_options.seed, at), drawLabBatch(m_lab, m_architecture, lab, m_options.seed, at)};
}

LabSteps::HalvedBatch LabSteps::take(int number)
{
    HalvedBatch now = m_next.valid() && m_nextNumber == number ? m_next.get() : draw(number);
    m_nextNumber = number + 1;
    m_next = std::async(std::launch::async, [this, wanted = m_nextNumber] { return draw(wanted); });
    return now;
}

LabLosses LabSteps::step(int number, double fraction)
{
    const HalvedBatch batch = take(number);
    const std::int64_t drawnCount = batch.drawn.size, labCount = batch.lab.cloth.size;
    const ClothTensors drawn = clothTensors(batch.drawn), lab = clothTensors(batch.lab.cloth);
    SeeingNetworks& networks = m_trained.now();
    setTraining(networks, false);
    const torch::Tensor texture = seenTexture(torch::cat({drawn.photographs, lab.photographs}));
    const torch::Tensor relief = networks.relief->forward(texture, torch::cat({drawn.lamps, lab.lamps}));
    const SeenFriction friction = networks.friction->forward(texture, relief, torch::cat({drawn.logPitches, lab.logPitches}));
    const SeenFriction drawnFriction = partOf(friction, 0, drawnCount), labFriction = partOf(friction, drawnCount, labCount);
    const torch::Tensor ofDrawn = reliefLoss(relief.narrow(0, 0, drawnCount), drawn.reliefs, {}) +
                                  frictionLoss(drawnFriction, drawn.logFrictions) +
                                  spectrogramLoss(drawnFriction, drawn.logRatios);
    const torch::Tensor labRelief = labReliefLoss(relief.narrow(0, drawnCount, labCount), lab.reliefs, batch.lab);
    const torch::Tensor labFrictionLoss = frictionLoss(labFriction, lab.logFrictions);
    const torch::Tensor ofLab = labRelief + labFrictionLoss + spectrogramLoss(labFriction, lab.logRatios);
    m_trained.step(0.5 * (ofDrawn + ofLab), learningRateAt(m_options.learningRate, fraction, number, labWarmUpSteps), number);
    return {labRelief.item<double>(), labFrictionLoss.item<double>(), ofDrawn.item<double>()};
}

}  // namespace rendering::models
