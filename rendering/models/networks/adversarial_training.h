// Adversarial training of generators and discriminator, one step of both at a time. The result of a default training is the
// exponential moving average of the generators' weights. Only the torch sources of this folder include it.
#pragma once

#include <future>

#include "rendering/models/networks/batches.h"
#include "rendering/models/networks/discriminator_training.h"
#include "rendering/models/networks/progress_lines.h"
#include "rendering/models/networks/training.h"
#include "rendering/models/networks/weights.h"

namespace rendering::models {

LossWeights weightsFor(Objective objective);
DistanceScales scalesOf(const TrainingData& data);

class AdversarialTraining {
public:
    /// `data` and `options` must outlive this object.
    AdversarialTraining(const TrainingData& data, const TrainingOptions& options);

    /// Runs one step; `fraction` of the training is done, which sets the learning rate. Each step draws its batch from its own
    /// random stream, so a resumed run draws the same batches as an uninterrupted one.
    StepLosses step(int number, double fraction);

    /// Generators that this training would return if it ended now.
    Generators& result() { return averages() ? m_average : m_generators; }
    /// True where all parameters are finite; a step may diverge even if its loss is finite.
    bool finite();
    /// Copies the present result as the best one.
    void keepAsBest();
    Generators& best() { return m_best; }

    /// All networks and optimisers, always the same tensors in the same order.
    std::vector<StoredTensor> tensors();
    /// Continues from the result of tensors().
    void continueFrom(const std::vector<StoredTensor>& tensors);

private:
    struct DrawnBatches {
        Batch pairs, strokes;
    };
    DrawnBatches drawBatches(int number) const;
    DrawnBatches takeBatches(int number);
    bool averages() const { return m_options.objective != Objective::Reference; }
    double rateAt(int number, double fraction) const;
    void updateAverage(int number);
    std::vector<NamedTensor> networkTensors() const;

    const TrainingData& m_data;
    const TrainingOptions& m_options;
    LossWeights m_weights;
    Generators m_generators, m_average, m_best;
    DiscriminatorTraining m_discriminator;
    torch::optim::Adam m_generatorSteps;
    std::future<DrawnBatches> m_next;  ///< drawn during the computation of the present step
    int m_nextNumber = -1;
};

}  // namespace rendering::models
