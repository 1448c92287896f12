// Data set -> friction images of fabrics x conditions, computing each needed signal once per fabric
// and nothing else.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocols/condition.h"
#include "rendering/composition/friction_image.h"
#include "rendering/composition/plan.h"
#include "rendering/fabrics/dataset.h"
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
    std::vector<protocols::FabricId> fabrics;    ///< what to write
    std::vector<protocols::FabricId> rangeOver;  ///< whose maps set the range; empty: all of the data set
    std::vector<protocols::ConditionId> conditions;
    std::map<protocols::FabricId, SampleChoice> samples;  ///< missing: the first sample of each signal
    Scale scale = Scale::Pixels;
    Extension extension = Extension::Tile;
    Percentiles percentiles;  ///< of the pixels of all objects together; 0 and 100: their least and greatest value
    DisplayMapping mapping;
    signals::ShadingOptions shading;       ///< of v_shape; its quality follows from generation.quality
    models::GenerationOptions generation;  ///< model and quality; what is generated follows from the conditions

    /// Asked at most once, with the photographs of all fabrics, and only where a condition needs it.
    std::function<std::vector<models::GeneratedSignals>(std::span<const models::InputPhotograph>,
                                                        const models::GenerationOptions&)>
        generate = models::generate;
};

/// Signals of one fabric, so that measured and generated can be compared and shown.
struct FabricSignals {
    std::map<Signal, cv::Mat> images;
    std::map<Signal, std::vector<double>> traces;
    std::optional<double> measuredMeanFriction, generatedMeanFriction;
    std::optional<signals::Light> light;                ///< that shape from shading was lit by
    std::optional<double> colourVariation;              ///< of the photograph it was made from
    std::optional<models::PhotographFacts> photograph;  ///< where something was generated from it
    std::string measuredQuantity = "mu";                ///< what the measured trace holds; "mu": a coefficient
    std::optional<double> photographMmPerPixel, tactileMmPerPixel, generatedMmPerPixel, traceMmPerSample,
        generatedTraceMmPerSample;
};

/// What became of a source on its way to the screen.
struct MapFacts {
    std::string extension;               ///< how a source smaller than the screen was continued
    double agreement = 0;                ///< of overlapping strips, correlation
    std::optional<double> varianceLost;  ///< ScaledMap::varianceLost
    double outsideRange = 0;             ///< share of pixels that robust percentiles cut off
};

struct RenderedCondition {
    protocols::ConditionId condition;
    MapRange range;  ///< of the first fabric written
    /// By the quantity of the measured friction ("" where none is used): a coefficient and a count of
    /// sensor units have no common range.
    std::map<std::string, MapRange> ranges;
    std::vector<protocols::FabricId> rangeOver;     ///< whose maps the ranges are of
    std::map<protocols::FabricId, MapFacts> maps;   ///< of RenderRequest::fabrics
    std::map<protocols::FabricId, cv::Mat> images;  ///< [800 x 1280], CV_8UC1 or CV_16UC1, of RenderRequest::fabrics
    double milliseconds = 0;
};

struct Rendering {
    std::vector<RenderedCondition> conditions;
    std::map<protocols::FabricId, FabricSignals> signals;
    std::map<Signal, int> computed;         ///< how often each signal was computed
    std::map<Signal, double> milliseconds;  ///< spent on it, all fabrics; both generators under the first
    std::map<protocols::FabricId, SampleChoice> samples;
};

/// `progress(done, total, what)`. Throws badInput naming the fabric and the signal that the data set
/// lacks for an image asked for, before anything is computed; a fabric that would only take part in the
/// range is left out of it instead.
Rendering renderFabrics(const fabrics::Dataset& dataset, const RenderRequest& request,
                        const std::function<void(int, int, const std::string&)>& progress = {});

/// The text of render.json: range and its set, samples, signals computed, extension, variance lost, ms.
std::string renderJson(const fabrics::Dataset& dataset, const RenderRequest& request, const Rendering& rendering);

/// What became of each fabric's sources, a line a fabric for people.
std::vector<std::string> describeMaps(const Rendering& rendering);

/// Fabrics whose photographs break the assumption of shape from shading, that only slope changes brightness; a line each.
std::vector<std::string> shadingWarnings(const Rendering& rendering);

/// Photographs that the generators know nothing like of, a line each; one more where the weights do not tell.
std::vector<std::string> unfamiliarPhotographs(const Rendering& rendering);

/// Photographs of which only the middle is used, a line each.
std::vector<std::string> cutPhotographs(const Rendering& rendering);

}  // namespace rendering
