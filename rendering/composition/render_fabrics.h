// Friction images of fabrics x conditions from a data set. Each needed signal is computed once for each fabric, and
// nothing else.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocols/condition.h"
#include "rendering/cache/result_cache.h"
#include "rendering/composition/display_mapping.h"
#include "rendering/composition/friction_image.h"
#include "rendering/composition/plan.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/models/cloth/cloth_check.h"
#include "rendering/models/generation.h"
#include "rendering/signals/shape_from_shading.h"

namespace rendering {

struct SampleChoice {
    int visual = 0, tactile = 0, friction = 0;  ///< sample indices
};

struct Percentiles {
    double low = 0, high = 100;  ///< 0 <= low < high <= 100
    bool whole() const { return low <= 0 && high >= 100; }
    bool operator==(const Percentiles&) const = default;
};

struct RenderRequest {
    std::vector<protocols::FabricId> fabrics;    ///< fabrics whose images are rendered
    std::vector<protocols::FabricId> rangeOver;  ///< fabrics whose maps set the range; empty: all of the data set
    std::vector<protocols::ConditionId> conditions;
    std::map<protocols::FabricId, SampleChoice> samples;  ///< for missing fabrics the first sample of each signal
    DisplayScale scale = DisplayScale::Pixels;
    Extension extension = Extension::Tile;
    Percentiles percentiles;  ///< taken over the pixels of all fabrics together; 0 and 100 are the least and greatest value
    DisplayMapping mapping;
    signals::ShadingOptions shading;  ///< for v_shape; its quality follows from generation.quality
    /// Model, and the quality of conditions that carry none; the conditions determine which signals are generated.
    models::GenerationOptions generation;

    /// Called at most once, with the photographs of all fabrics, and only if a condition needs it.
    std::function<std::vector<models::GeneratedSignals>(std::span<const models::InputPhotograph>,
                                                        const models::GenerationOptions&)>
        generate = models::generate;

    /// Keeps signals and ranges, and gives those that were kept before; null: everything is computed.
    std::shared_ptr<cache::ResultCache> cache = nullptr;
};

/// Signals of one fabric, for comparing and showing measured and generated ones.
struct FabricSignals {
    std::map<Signal, cv::Mat> images;
    std::map<Signal, std::vector<double>> traces;
    std::optional<double> measuredMeanFriction, generatedMeanFriction;
    std::optional<signals::Light> light;                ///< light that shape from shading used
    std::optional<double> shapeLeftOut;                 ///< where v_shape was computed for the screen only: signals::ReliefPart
    std::optional<double> colourVariation;              ///< measured on the photograph that shape from shading used
    std::optional<models::PhotographFacts> photograph;  ///< set where signals were generated from it
    std::string measuredQuantity = "mu";                ///< quantity of the measured trace; "mu" for a coefficient
    std::optional<double> photographMmPerPixel, tactileMmPerPixel, generatedMmPerPixel, traceMmPerSample,
        generatedTraceMmPerSample;
    std::optional<models::ClothLikeness> likeness;  ///< of the photograph, where signals are generated from it
    std::optional<fabrics::Fibre> fibre = {};       ///< as dataset.json states it
    std::optional<double> photographLightDeg;       ///< side of the lamp, where samples.csv states it
    /// Time of each signal; that of a trace is part of its spectrogram's. Starting vis2hap-nn and loading weights are left out.
    std::map<Signal, double> milliseconds = {};
};

/// Facts on the conversion of a source to a map on the screen.
struct MapFacts {
    std::string extension;               ///< method that extends a source smaller than the screen
    double agreement = 0;                ///< correlation of overlapping strips
    std::optional<double> varianceLost;  ///< ScaledMap::varianceLost
    double outsideRange = 0;             ///< share of pixels outside the range between percentiles
    double outOfReach = 0;               ///< share of pixels whose friction the display's response does not reach
};

struct RenderedCondition {
    protocols::ConditionId condition;
    models::Quality quality = models::Quality::Balanced;
    MapRange range;  ///< range of the first rendered fabric
    /// Ranges by quantity of the measured friction ("" where none is used), because a coefficient and a count of sensor units
    /// have no common range.
    std::map<std::string, MapRange> ranges;
    /// Fabrics with the least and the greatest value of the first range (of the whole range where percentiles are asked for).
    struct RangeSetters {
        protocols::FabricId lowest, highest;
    } rangeSetBy = {};
    std::vector<protocols::FabricId> rangeOver;     ///< fabrics whose maps set the ranges
    std::map<protocols::FabricId, MapFacts> maps;   ///< for each of RenderRequest::fabrics
    std::map<protocols::FabricId, cv::Mat> images;  ///< [800 x 1280], CV_8UC1 or CV_16UC1, for each of RenderRequest::fabrics
    double milliseconds = 0;
};

struct RenderedFabrics {
    std::vector<RenderedCondition> conditions;
    /// Signals at the usual quality. One that is needed at other qualities only is here at the most accurate of them. Of rendered
    /// fabrics, and of those whose ranges were unknown.
    std::map<protocols::FabricId, FabricSignals> signals;
    std::map<models::Quality, std::map<protocols::FabricId, FabricSignals>> signalsAt;  ///< those that conditions use
    std::map<Signal, int> computed;         ///< number of computations of each signal; kept ones do not count
    int keptRanges = 0;                     ///< maps whose range the cache knew
    std::map<Signal, double> milliseconds;  ///< time over all fabrics and qualities; both generators are counted under the first
    std::map<protocols::FabricId, SampleChoice> samples;
};

/// The quality of a condition: its own, or the usual one of the request.
models::Quality qualityOf(const protocols::ConditionId& condition, const RenderRequest& request);

/// `progress(done, total, what)` reports each step. Throws badInput before any computation where the data set lacks a signal
/// for a requested image; it names the fabric and the signal. A fabric that only contributes to the range is left out instead.
RenderedFabrics renderFabrics(const fabrics::Dataset& dataset, const RenderRequest& request,
                              const std::function<void(int, int, const std::string&)>& progress = {});

}  // namespace rendering
