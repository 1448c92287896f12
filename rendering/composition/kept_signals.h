// Signals of photographs and tactile frames that a cache keeps, with the facts that come with them.
#pragma once

#include <functional>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

class KeptSignals {
public:
    /// Without a cache, everything is computed. Both outlive this value.
    KeptSignals(cache::ResultCache* cache, const fabrics::Dataset& dataset) : m_cache(cache), m_dataset(dataset) {}

    bool isOn() const { return m_cache != nullptr; }

    /// Height of a tactile frame through a calibration, mm. `compute` is called where the cache lacks it. `result` gets the time
    /// that computing took, now or when it was kept: the price of a signal is not that of reading a file.
    cv::Mat height(const protocols::FabricId& fabric, int index, models::Quality quality, FabricSignals& result,
                   const std::function<cv::Mat()>& compute);

    /// Relief of a photograph; fills the facts on light and colour in `signals`, as `compute` does where the cache lacks it.
    /// `shown`: size of the part that is computed of large photographs.
    cv::Mat relief(const protocols::FabricId& fabric, int index, const signals::ShadingOptions& options, cv::Size shown,
                   FabricSignals& result, const std::function<cv::Mat()>& compute);

private:
    cache::ResultCache* m_cache;
    const fabrics::Dataset& m_dataset;
};

}  // namespace rendering
