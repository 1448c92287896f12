#include "study/making/signal_controls.h"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "study/analyse/statistic_json.h"

namespace study::making {

namespace {

using analyse::put;
using evaluation::ComparedSource;
using evaluation::Measure;
using nlohmann::ordered_json;
using rendering::FabricSignals;
using rendering::Signal;

/// Name of a measure in the study's results.
struct StudyField {
    Measure measure;
    const char* name;
};

constexpr StudyField studyFields[] = {{Measure::FrictionMae, "friction_mae"},
                                      {Measure::FrictionMaeOverMean, "friction_mae_over_mean"},
                                      {Measure::MeanFrictionError, "mean_friction_error"},
                                      {Measure::FrictionSpectrum, "friction_spectrum_db"},
                                      {Measure::Ssim, "height_ssim"},
                                      {Measure::SsimRegistered, "height_ssim_registered"},
                                      {Measure::HeightSpectrum, "height_spectrum_db"},
                                      {Measure::SqRatio, "height_sq_ratio"}};

std::string fieldOf(Measure measure)
{
    for (const StudyField& field : studyFields)
        if (field.measure == measure) return field.name;
    return {};
}

/// The measures that stand beside the fields of earlier versions.
constexpr Measure addedMeasures[] = {Measure::SsimRegistered, Measure::HeightSpectrum, Measure::SqRatio,
                                     Measure::MeanFrictionError, Measure::FrictionSpectrum};

void putMeasures(ordered_json& json, const evaluation::Values& values)
{
    for (const StudyField& field : studyFields) put(json, field.name, at(values, field.measure));
}

ordered_json differenceJson(const evaluation::MeasureDifference& difference)
{
    ordered_json json{{"n", difference.test.n}};
    put(json, "mean_difference", difference.test.estimate);
    put(json, "ci95", difference.test.ci);
    put(json, "p", difference.test.p);
    put(json, "p_holm", difference.pHolm);
    return json;
}

ordered_json sourceJson(const ComparedSource& source)
{
    ordered_json json{{"name", source.name}};
    if (source.steps) json["steps"] = *source.steps;
    if (!source.whyUnfair.empty()) json["not_a_fair_control"] = source.whyUnfair;
    putMeasures(json, source.result.mean);
    if (!source.differences.empty()) {
        json["difference"] = ordered_json::object();
        for (const auto& difference : source.differences)
            json["difference"][fieldOf(difference.measure)] = differenceJson(difference);
    }
    json["fabrics"] = ordered_json::array();
    for (const auto& fabric : source.result.fabrics) {
        ordered_json one{{"fabric", fabric.fabric.value}};
        putMeasures(one, fabric.values);
        json["fabrics"].push_back(one);
    }
    return json;
}

/// All fields without a number, for one reason.
void putNothing(ordered_json& json, const std::string& why)
{
    for (const Measure measure : addedMeasures) put(json, fieldOf(measure), stats::Value::undefined(why));
    put(json, "controls", stats::Value::undefined(why));
}

bool hasImage(const FabricSignals& signals, Signal signal)
{
    const auto found = signals.images.find(signal);
    return found != signals.images.end() && !found->second.empty();
}

bool hasTrace(const FabricSignals& signals, Signal signal)
{
    const auto found = signals.traces.find(signal);
    return found != signals.traces.end() && !found->second.empty();
}

bool hasGenerated(const FabricSignals& signals)
{
    return hasImage(signals, Signal::GeneratedHeight) || hasTrace(signals, Signal::GeneratedTrace);
}

/// The measured samples that a study shows beside generated signals of the same kind.
evaluation::ShownSamples shownSamples(const protocols::FabricId& fabric, const FabricSignals& signals,
                                      const rendering::SampleChoice& samples)
{
    evaluation::ShownSamples shown{fabric, samples.visual, {}, {}};
    if (hasImage(signals, Signal::PhotometricHeight)) shown.press = samples.tactile;
    if (hasTrace(signals, Signal::MeasuredTrace) && signals.measuredQuantity == "mu") shown.stroke = samples.friction;
    return shown;
}

rendering::models::GeneratedSignals generatedSignals(const FabricSignals& signals)
{
    rendering::models::GeneratedSignals generated;
    if (hasImage(signals, Signal::GeneratedHeight)) {
        generated.heightMm = signals.images.at(Signal::GeneratedHeight);
        generated.heightMmPerPixel = signals.generatedMmPerPixel.value_or(0);
    }
    if (hasTrace(signals, Signal::GeneratedTrace)) {
        generated.trace = signals.traces.at(Signal::GeneratedTrace);
        generated.traceMmPerSample = signals.generatedTraceMmPerSample.value_or(0);
        generated.meanFriction = signals.generatedMeanFriction.value_or(0);
    }
    return generated;
}

evaluation::StudyComparisonRequest comparisonOf(const ControlsRequest& request)
{
    evaluation::StudyComparisonRequest comparison;
    for (const auto& [fabric, signals] : request.rendering.signals) {
        if (!hasGenerated(signals)) continue;
        const auto samples = request.material.render.samples.find(fabric);
        if (samples == request.material.render.samples.end()) continue;
        comparison.shown.push_back(shownSamples(fabric, signals, samples->second));
        comparison.generated.push_back(generatedSignals(signals));
    }
    comparison.model = *request.material.model;
    comparison.control = request.material.control;
    comparison.datasetSha256 = request.datasetSha256;
    comparison.seed = request.seed;
    return comparison;
}

}  // namespace

void putComparison(ordered_json& json, const evaluation::StudyComparison& comparison)
{
    const auto& generated = comparison.sources.front().result.mean;
    for (const Measure measure : addedMeasures) put(json, fieldOf(measure), at(generated, measure));
    json["pairing"] = comparison.aligned ? "aligned" : "weak";
    json["controls_know"] = {
        {"photographs", comparison.photographs}, {"presses", comparison.presses}, {"strokes", comparison.strokes}};
    json["notes"] = comparison.notes;
    json["controls"] = ordered_json::object();
    for (const ComparedSource& source : comparison.sources) {
        const bool isGenerated = source.result.predictor.kind == evaluation::PredictorKind::Generated ||
                                 source.result.predictor.kind == evaluation::PredictorKind::GeneratedMean;
        (isGenerated ? json : json["controls"])[source.result.predictor.id] = sourceJson(source);
    }
}

void addControls(ordered_json& json, const ControlsRequest& request, const evaluation::Report& report)
{
    if (!request.material.model) return putNothing(json, "the study's conditions compute no generated signal");
    const auto comparison = comparisonOf(request);
    if (comparison.shown.empty()) return putNothing(json, "the study's conditions compute no generated signal");
    try {
        putComparison(json,
                      evaluation::compareStudy(request.material.dataset, comparison, report, request.material.render.generate));
    } catch (const protocols::Error& fault) {
        putNothing(json, std::string("the controls could not be computed: ") + fault.what());
    } catch (const cv::Exception& fault) {
        putNothing(json, std::string("the controls could not be computed: ") + fault.what());
    }
}

}  // namespace study::making
