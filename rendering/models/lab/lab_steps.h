// One step of an adaptation: half of the patches are a laboratory's own cloth, half are drawn fabrics and scans, so that the
// abilities that the model was shipped with stay. Only the torch sources include it.
#pragma once

#include <future>

#include "rendering/models/lab/lab_batches.h"
#include "rendering/models/lab/lab_figures.h"
#include "rendering/models/seeing/averaged_networks.h"
#include "rendering/models/seeing/cloth_training.h"

namespace rendering::models {

struct LabLosses {
    double relief = 0, friction = 0;  ///< on the lab's cloth
    double drawn = 0;                 ///< relief, friction and spectrogram of drawn cloth
};

class LabSteps {
public:
    /// All arguments but `architecture` must outlive this object. The factors of `architecture` are taken out of the targets.
    LabSteps(const LabCloth& lab, const std::vector<ScannedCloth>& scans, const Architecture& architecture,
             const ClothTrainingOptions& options);

    /// As ClothTraining::step(). Running statistics of the networks stay as they are: a few photographs of one camera would
    /// spoil them.
    LabLosses step(int number, double fraction);

    AveragedNetworks& networks() { return m_trained; }

private:
    /// Both halves of a step.
    struct HalvedBatch {
        ClothBatch drawn;
        LabBatch lab;
    };
    HalvedBatch draw(int number) const;
    HalvedBatch take(int number);

    const LabCloth& m_lab;
    const std::vector<ScannedCloth>& m_scans;
    const Architecture m_architecture;
    const ClothTrainingOptions& m_options;
    AveragedNetworks m_trained;
    std::future<HalvedBatch> m_next;
    int m_nextNumber = -1;
};

}  // namespace rendering::models
