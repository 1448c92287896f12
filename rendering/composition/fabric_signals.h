// The signals of one fabric: whether the data set has what they are made of, reading and computing
// them, and what a condition takes from them.
#pragma once

#include <optional>
#include <set>

#include "protocols/files/errors.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/signals/photometric_stereo.h"

namespace rendering {

/// The first sample of each signal that the data set has of a fabric; 0 where it has none.
SampleChoice firstSamples(const fabrics::Dataset& dataset, const protocols::FabricId& fabric);

/// Why a condition of a fabric cannot be rendered: what the data set lacks. Reads no image.
std::optional<protocols::Fault> lackOf(const fabrics::Dataset& dataset, const protocols::FabricId& fabric,
                                       const SampleChoice& samples, const protocols::Condition& condition, Scale scale);

/// Reads and computes signals, each at most once, and counts and times them.
class SignalWorkshop {
public:
    SignalWorkshop(const fabrics::Dataset& dataset, models::Quality quality, const signals::ShadingOptions& shading = {})
        : m_dataset(dataset), m_quality(quality), m_shading(shading)
    {
        if (quality == models::Quality::Fast) m_shading.quality = signals::ShadingQuality::Fast;
    }

    /// All of `needed` that no generator makes.
    FabricSignals measured(const protocols::FabricId& fabric, const SampleChoice& samples, const std::set<Signal>& needed,
                           Rendering& counts);

private:
    cv::Mat tactileHeight(const protocols::FabricId& fabric, int index, const cv::Mat& frame);

    const fabrics::Dataset& m_dataset;
    models::Quality m_quality;
    signals::ShadingOptions m_shading;
    cv::Mat m_reference;
    std::optional<signals::Calibration> m_calibration;
};

/// Puts what the generators made of a fabric's photograph to its signals.
void addGenerated(FabricSignals& signals, models::GeneratedSignals generated, const std::set<Signal>& needed);

/// Relief and friction of a condition. All signals that it needs must be there.
Sources sourcesOf(const protocols::Condition& condition, const FabricSignals& signals);

}  // namespace rendering
