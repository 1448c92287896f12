// Ranges of single maps that a cache keeps, so that one fabric can be rendered without the recordings of all others.
#pragma once

#include <optional>
#include <string>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

/// Least and greatest value of the map of one condition of one fabric.
struct KeptRange {
    double min = 0, max = 0;
    std::string quantity;  ///< of its measured friction; "" where none is used
    bool operator==(const KeptRange&) const = default;
};

class KeptRanges {
public:
    /// Without a cache in the request nothing is found. Both outlive this value.
    KeptRanges(const fabrics::Dataset& dataset, const RenderRequest& request);

    std::optional<KeptRange> find(const protocols::FabricId& fabric, const SampleChoice& samples,
                                  const protocols::ConditionId& condition);
    /// Does not keep the range of a map whose photograph the user must be warned of: the warning must come each time.
    void keep(const protocols::FabricId& fabric, const SampleChoice& samples, const protocols::ConditionId& condition,
              const FabricSignals& signals, const KeptRange& range);

private:
    std::string keyOf(const protocols::FabricId& fabric, const SampleChoice& samples, const protocols::ConditionId& condition);

    const fabrics::Dataset& m_dataset;
    const RenderRequest& m_request;
    std::optional<std::string> m_datasetJson, m_generators;  ///< computed when they are first needed
};

}  // namespace rendering
