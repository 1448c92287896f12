// Generators and discriminator on their way: one step of both, and the running average of the
// generators' weights, which is what a default training gives.
// Included by this folder's torch sources only.
#pragma once

#include <future>

#include "rendering/models/networks/batches.h"
#include "rendering/models/networks/losses.h"
#include "rendering/models/networks/progress_lines.h"
#include "rendering/models/networks/training.h"
#include "rendering/models/networks/weights.h"

namespace rendering::models {

LossWeights weightsFor(Objective objective);
DistanceScales scalesOf(const TrainingData& data);

class Contest {
public:
    /// Both outlive the contest.
    Contest(const TrainingData& data, const TrainingOptions& options);

    /// `fraction` of the training done, for the falling rate. Each step's batch comes from its own
    /// stream, so a resumed run draws what the unbroken one would have drawn.
    StepLosses step(int number, double fraction);

    /// What this training would give if it ended here.
    Generators& result() { return averages() ? m_average : m_generators; }
    /// A finite loss may still be followed by a step out of all bounds.
    bool finite();
    /// The result as it is now is kept as the best so far.
    void keepAsBest();
    Generators& best() { return m_best; }

    void save(torch::serialize::OutputArchive& archive);
    void load(torch::serialize::InputArchive& archive);

private:
    struct Drawn {
        Batch pairs, strokes;
    };
    Drawn drawn(int number) const;
    Drawn takeDrawn(int number);
    bool averages() const { return m_options.objective != Objective::Reference; }
    void setRates(int number, double fraction);
    double stepDiscriminator(const torch::Tensor& photograph, const Touch& measured, const Touch& generated);
    void follow(int number);
    template <class Visit>
    void eachPart(Visit visit);

    const TrainingData& m_data;
    const TrainingOptions& m_options;
    LossWeights m_weights;
    Generators m_generators, m_average, m_best;
    Discriminator m_discriminator;
    torch::optim::Adam m_generatorSteps, m_discriminatorSteps;
    std::future<Drawn> m_next;  ///< drawn while the present step is computed
    int m_nextNumber = -1;
};

}  // namespace rendering::models
