// One training step of the networks that see, and their figures on drawn fabrics that training never shows.
// Only the torch sources include it.
#pragma once

#include <cmath>
#include <future>
#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "rendering/models/seeing/averaged_networks.h"
#include "rendering/models/seeing/cloth_batches.h"
#include "rendering/models/seeing/cloth_tensors.h"
#include "rendering/models/seeing/cloth_training.h"
#include "rendering/models/seeing/training_peers.h"

namespace rendering::models {

/// The losses of a step by our objective: reliefLoss(), the mean negative log-likelihood of log friction, and the mean absolute
/// difference of logarithms of magnitudes. Other objectives have their own.
struct ClothLosses {
    double relief = 0, friction = 0, spectrogram = 0;
};

/// What a training descends: the sum of three losses, each a scalar.
class ClothObjective {
public:
    struct Losses {
        torch::Tensor relief, friction, spectrogram;
    };

    virtual ~ClothObjective() = default;
    /// "default", or the name of a control, as in the model card.
    virtual std::string name() const { return "default"; }
    /// Asked once in each step, in order. `learningRate`: that of the networks in this step.
    virtual Losses of(const ClothTensors& batch, const torch::Tensor& relief, const SeenFriction& friction, double learningRate);

    /// What the objective learns itself, always the same tensors in the same order.
    virtual std::vector<StoredTensor> tensors() { return {}; }
    /// Takes them from `tensors`, beginning at `next`, which moves behind them.
    virtual void continueFrom(const std::vector<StoredTensor>& tensors, std::size_t& next);
};

class ClothTraining {
public:
    /// `scans` and `options` must outlive this object.
    ClothTraining(const Architecture& architecture, const std::vector<ScannedCloth>& scans, const ClothTrainingOptions& options);

    /// From now on this process draws and computes its rows of every batch; the other processes have the others. `peers` must
    /// outlive this object. Takes networks and optimiser of rank 0.
    void shareWith(const TrainingPeers& peers);

    /// Runs one step; `fraction` of the training is done, which sets the learning rate. Step `number` always draws the same
    /// batch, so a resumed run draws the batches of an uninterrupted one.
    ClothLosses step(int number, double fraction);
    bool finite() { return m_trained.finite(); }

    /// Starts from trained networks instead of new ones.
    void startFrom(SeeingNetworks& networks) { m_trained.startFrom(networks); }

    std::string objective() const { return m_objective->name(); }

    /// Moving average of the weights: the result.
    SeeingNetworks& result() { return m_trained.average(); }

    /// Networks, optimiser and objective, always the same tensors in the same order.
    std::vector<StoredTensor> tensors();
    void continueFrom(const std::vector<StoredTensor>& tensors);

private:
    ClothBatch takeBatch(int number);

    const std::vector<ScannedCloth>& m_scans;
    const Architecture m_architecture;
    const ClothTrainingOptions& m_options;
    AveragedNetworks m_trained;
    std::unique_ptr<ClothObjective> m_objective;
    std::future<ClothBatch> m_next;  ///< drawn during the computation of the present step
    int m_nextNumber = -1;
    const TrainingPeers* m_peers = nullptr;
};

/// What the networks make of a drawn patch, beside what is known.
struct SeenPatch {
    double correlation = 0, sqRatio = 0;
    double logError = 0, logSpread = 0, friction = 0;  ///< of the mean friction: error of its logarithm, stated deviation, truth
    fabrics::Fibre fibre = fabrics::Fibre::Cotton;
    double standardError() const { return std::abs(logError) / std::exp(logSpread); }
    double frictionError() const { return std::abs(std::expm1(logError)); }  ///< relative
};

/// At least `patches` drawn fabrics of a family; equal arguments give equal batches.
std::vector<ClothBatch> drawnBatches(const Architecture& architecture, int patches, std::uint64_t family);

/// In the order of the batches. Leaves the networks in training mode.
std::vector<SeenPatch> seenPatches(SeeingNetworks& networks, const std::vector<ClothBatch>& batches);

/// Figures over `patches` drawn fabrics of a family of their own: relief_correlation (mean and median, without slow parts),
/// sq_ratio_low and sq_ratio_high (5 and 95 % of generated over known Sq), friction_error (mean relative error of the mean
/// coefficient), friction_constant_error (the same of one constant), friction_coverage (share inside the 90 % interval).
nlohmann::ordered_json clothFigures(SeeingNetworks& networks, const Architecture& architecture, int patches, std::uint64_t seed);

/// Sets Architecture::intervalFactor, so that 90 % of `patches` drawn fabrics lie in the 90 % interval (0.2 to 5), and
/// Architecture::fibres. The fabrics belong to a family that neither training nor clothFigures() shows.
void calibrateFriction(SeeingNetworks& networks, Architecture& architecture, int patches, std::uint64_t seed);

}  // namespace rendering::models
