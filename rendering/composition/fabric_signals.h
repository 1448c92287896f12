// Signals of one fabric: whether the data set has their inputs, their computation, and the sources that a condition
// takes from them.
#pragma once

#include <optional>
#include <set>

#include "protocols/files/errors.h"
#include "rendering/composition/kept_signals.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/preset.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering {

/// Index of the first sample of each signal of a fabric; 0 where the data set has none.
SampleChoice firstSamples(const fabrics::Dataset& dataset, const protocols::FabricId& fabric);

/// Input that the data set lacks for a condition of a fabric, as a fault; nullopt where it can be rendered. Reads no image.
std::optional<protocols::Fault> missingInput(const fabrics::Dataset& dataset, const protocols::FabricId& fabric,
                                             const SampleChoice& samples, const protocols::Condition& condition,
                                             DisplayScale scale);

/// Reads and computes signals, each at most once; counts them and measures their time.
class SignalComputation {
public:
    /// `shown`: of larger photographs, only the middle of this size is turned into a relief by the linear method. Empty: all.
    /// `cache`: keeps costly signals. A recording is then read only for a signal that the cache lacks.
    SignalComputation(const fabrics::Dataset& dataset, models::Quality quality, const signals::ShadingOptions& shading = {},
                      cv::Size shown = {}, cache::ResultCache* cache = nullptr)
        : m_dataset(dataset), m_quality(quality), m_shading(shading), m_shown(shown), m_views(dataset), m_kept(cache, dataset)
    {
        if (models::presetOf(quality).shading == signals::ShadingQuality::Fast) m_shading.quality = signals::ShadingQuality::Fast;
    }

    /// Signals in `needed`, except those that a generator makes. `known`: the same fabric's signals of another quality; those
    /// that no quality changes are taken from it.
    FabricSignals measured(const protocols::FabricId& fabric, const SampleChoice& samples, const std::set<Signal>& needed,
                           RenderedFabrics& counts, const FabricSignals& known = {});

private:
    cv::Mat reliefOf(const cv::Mat& photograph, FabricSignals& result) const;
    cv::Mat tactileHeight(const protocols::FabricId& fabric, int index, const cv::Mat& frame);
    void addMeasuredTrace(const protocols::FabricId& fabric, int sample, const std::set<Signal>& needed, RenderedFabrics& counts,
                          const FabricSignals& known, FabricSignals& result) const;

    const fabrics::Dataset& m_dataset;
    models::Quality m_quality;
    signals::ShadingOptions m_shading;
    cv::Size m_shown;
    fabrics::PhotographViews m_views;
    KeptSignals m_kept;
    cv::Mat m_reference;
    std::optional<signals::Calibration> m_calibration;
};

/// Adds the signals that the generators made from a fabric's photograph.
void addGenerated(FabricSignals& signals, models::GeneratedSignals generated, const std::set<Signal>& needed);

/// Adds the signals of `other` that `signals` lacks.
void addMissing(FabricSignals& signals, const FabricSignals& other);

/// Relief and friction of a condition. All signals that it needs must exist.
Sources sourcesOf(const protocols::Condition& condition, const FabricSignals& signals);

}  // namespace rendering
