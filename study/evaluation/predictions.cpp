#include "study/evaluation/predictions.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace study::evaluation {

namespace {

HeightMap mapOf(const EvaluationContext& context, const PlannedSample& press)
{
    return {context.measured.height(press.fabric, press.index), context.measured.pitchMm(), press.rotationDeg.value_or(0)};
}

Trace traceOf(const EvaluationContext& context, const PlannedSample& stroke)
{
    const auto trace = context.measured.trace(stroke.fabric, stroke.index);
    return {trace.values, trace.mmPerSample};
}

HeightMap flat(const HeightMap& like, double heightMm)
{
    return {cv::Mat(like.heightMm.size(), CV_32FC1, cv::Scalar(heightMm)), like.pitchMm, 0};
}

void setUndefined(Values& values, Section section, const std::string& why)
{
    for (const MeasureRow& row : measureTable())
        if (row.section == section) at(values, row.measure) = stats::Value::undefined(why);
}

void setUndefinedHeight(Values& values, const std::string& why)
{
    setUndefined(values, Section::Height, why);
    setUndefined(values, Section::Roughness, why);
    at(values, Measure::SqMm) = at(values, Measure::IdentifiedByHeight) = at(values, Measure::IdentifiedByBoth) =
        stats::Value::undefined(why);
}

void setUndefinedFriction(Values& values, const std::string& why)
{
    setUndefined(values, Section::Friction, why);
    at(values, Measure::MeanFriction) = at(values, Measure::IdentifiedByFriction) = at(values, Measure::IdentifiedByBoth) =
        stats::Value::undefined(why);
}

stats::Value identified(const Identifier& identifier, const FeatureVector& features, std::size_t fabric)
{
    const auto found = identifier.classOf(features);
    if (!found) return stats::Value::undefined("there are fewer than two fabrics, or a signal is too small for features");
    return *found == fabric ? 1 : 0;
}

void identify(const EvaluationContext& context, const TestPair& pair, const std::optional<HeightFeatures>& height,
              const std::optional<FrictionFeatures>& friction, Values& values)
{
    const Identifiers& identifiers = *context.controls.identifiers;
    FeatureVector both;
    if (height) {
        both = featureVector(*height);
        at(values, Measure::IdentifiedByHeight) = identified(identifiers.byHeight, both, pair.fabric);
    }
    if (friction) {
        const FeatureVector features = featureVector(*friction);
        at(values, Measure::IdentifiedByFriction) = identified(identifiers.byFriction, features, pair.fabric);
        both.insert(both.end(), features.begin(), features.end());
    }
    if (height && friction) at(values, Measure::IdentifiedByBoth) = identified(identifiers.byBoth, both, pair.fabric);
}

std::string whyNo(const std::string& dataset, const char* partner)
{
    return dataset.empty() ? std::string("no measured ") + partner + " of the fabric is left for the comparison" : dataset;
}

/// Prediction by other samples of the data set.
Prediction predictBySamples(const EvaluationContext& context, const std::optional<PlannedSample>& press,
                            const std::optional<PlannedSample>& stroke, const std::string& why)
{
    Prediction prediction;
    prediction.whyNoHeight = prediction.whyNoTrace = why;
    if (press && context.measured.whyNoHeight().empty()) prediction.height = mapOf(context, *press);
    if (stroke && context.measured.whyNoFriction().empty()) prediction.trace = traceOf(context, *stroke);
    return prediction;
}

/// Prediction by the retrieved press and stroke. Retrieval does not know the rotation of the fabric in the test photograph.
/// So the retrieved map keeps the angle between the two photographs as an error.
Prediction predictByNeighbour(const EvaluationContext& context, const PlannedSample& tested, const RetrievedSamples& found)
{
    Prediction prediction =
        predictBySamples(context, found.press, found.stroke, "the training part has no such sample of the retrieved fabric");
    if (prediction.height && tested.rotationDeg && found.photograph.rotationDeg)
        prediction.height->rotationDeg += *tested.rotationDeg - *found.photograph.rotationDeg;
    return prediction;
}

Prediction predictByConstants(const EvaluationContext& context, const TestPair& pair, const MeasuredPair& measured,
                              const stats::Value& heightMm, const stats::Value& friction)
{
    Prediction prediction;
    prediction.whyNoHeight = heightMm.why();
    prediction.whyNoTrace = friction.why();
    if (heightMm.exists() && measured.heightFeatures) prediction.height = flat(measuredMap(context, pair), *heightMm);
    if (friction.exists() && measured.trace) prediction.trace = constantTrace(*friction, measured.trace->values.size());
    return prediction;
}

stats::Value covered(const std::optional<rendering::models::FrictionInterval>& interval, double truth)
{
    if (!interval) return stats::Value::undefined("it gives no interval of its mean friction");
    return truth >= interval->low && truth <= interval->high ? 1 : 0;
}

}  // namespace

MeasuredPair measurePair(const EvaluationContext& context, const TestPair& pair)
{
    MeasuredPair measured;
    if (pair.press && context.measured.whyNoHeight().empty()) {
        const HeightMap map = mapOf(context, *pair.press);
        measured.heightFeatures = heightFeatures(map, context.controls.featureSide);
        cv::minMaxLoc(map.heightMm, &measured.lowestMm, &measured.highestMm);
    }
    if (pair.stroke && context.measured.whyNoFriction().empty()) measured.trace = traceOf(context, *pair.stroke);
    return measured;
}

stats::Value rangeOf(const std::vector<MeasuredPair>& pairs)
{
    double lowest = 0, highest = 0;
    bool any = false;
    for (const MeasuredPair& pair : pairs) {
        if (!pair.heightFeatures) continue;
        lowest = any ? std::min(lowest, pair.lowestMm) : pair.lowestMm;
        highest = any ? std::max(highest, pair.highestMm) : pair.highestMm;
        any = true;
    }
    if (!any) return stats::Value::undefined("there is no measured height");
    if (!(highest > lowest)) return stats::Value::undefined("the measured heights are flat");
    return highest - lowest;
}

HeightMap measuredMap(const EvaluationContext& context, const TestPair& pair)
{
    return pair.press && context.measured.whyNoHeight().empty() ? mapOf(context, *pair.press) : HeightMap{};
}

Prediction predictByModel(const EvaluationContext& context, const TestPair& pair,
                          const rendering::models::GeneratedSignals& generated)
{
    Prediction prediction;
    prediction.whyNoHeight = "no height was generated";
    prediction.whyNoTrace = "no friction was generated";
    const double pitch = context.dataset.tactileMmPerPixel ? generated.heightMmPerPixel : context.measured.pitchMm();
    if (!generated.heightMm.empty())
        prediction.height =
            atPitch({generated.heightMm, pitch, pair.photograph.rotationDeg.value_or(0)}, context.measured.pitchMm());
    if (!generated.trace.empty()) prediction.trace = Trace{generated.trace, generated.traceMmPerSample};
    prediction.meanFriction = generated.photograph.meanFriction;
    return prediction;
}

Prediction predictByMean(const rendering::models::GeneratedSignals& generated, const MeasuredPair& measured)
{
    Prediction prediction;
    prediction.whyNoHeight = "this predictor gives friction only";
    prediction.whyNoTrace = "no friction was generated";
    if (measured.trace && !generated.trace.empty())
        prediction.trace = constantTrace(generated.meanFriction, measured.trace->values.size());
    return prediction;
}

Prediction predictByControl(const EvaluationContext& context, PredictorKind kind, std::size_t number,
                            const MeasuredPair& measured)
{
    const TestPair& pair = context.plan.pairs[number];
    const Controls& controls = context.controls;
    switch (kind) {
        case PredictorKind::GlobalConstant:
            return predictByConstants(context, pair, measured, controls.heightMm, controls.friction);
        case PredictorKind::FabricMean:
            return predictByConstants(context, pair, measured, controls.heightMmOfFabric[pair.fabric],
                                      controls.frictionOfFabric[pair.fabric]);
        case PredictorKind::Retrieval:
            if (controls.retrieved.empty()) return predictBySamples(context, {}, {}, controls.whyNoRetrieval);
            return predictByNeighbour(context, pair.photograph, controls.retrieved[number]);
        case PredictorKind::AnotherPlace:
            return predictBySamples(context, pair.otherPress, pair.otherStroke, "the fabric has no second sample of the signal");
        case PredictorKind::Generated:
        case PredictorKind::GeneratedMean:
        case PredictorKind::Against:
        case PredictorKind::Measured:
            break;
    }
    return {};
}

Values compare(const EvaluationContext& context, const TestPair& pair, const MeasuredPair& measured, const HeightMap& partner,
               const Prediction& prediction, double rangeMm)
{
    Values values;
    std::optional<HeightFeatures> height;
    std::optional<FrictionFeatures> friction;
    if (prediction.height && !partner.heightMm.empty()) {
        height = heightFeatures(*prediction.height, context.controls.featureSide);
        compareHeights(*prediction.height, *height, partner, *measured.heightFeatures, rangeMm, values);
    }
    if (prediction.trace && measured.trace) {
        const Trace trace = atSpacing(*prediction.trace, measured.trace->mmPerSample);
        friction = frictionFeatures(trace);
        compareTraces(trace, *measured.trace, values, context.measured.traceMmPerSample());
        at(values, Measure::FrictionCovered) = covered(prediction.meanFriction, frictionFeatures(*measured.trace).mean);
    }
    identify(context, pair, height, friction, values);
    if (!height)
        setUndefinedHeight(values,
                           measured.heightFeatures ? prediction.whyNoHeight : whyNo(context.measured.whyNoHeight(), "press"));
    if (!friction)
        setUndefinedFriction(values, measured.trace ? prediction.whyNoTrace : whyNo(context.measured.whyNoFriction(), "stroke"));
    return values;
}

Values valuesOfMeasured(const EvaluationContext& context, const TestPair& pair, const MeasuredPair& measured)
{
    Values values;
    for (const Section section : {Section::Friction, Section::Height, Section::Roughness})
        setUndefined(values, section, "these are the measured signals");
    std::optional<FrictionFeatures> friction;
    if (measured.trace) friction = frictionFeatures(*measured.trace);
    identify(context, pair, measured.heightFeatures, friction, values);
    if (measured.heightFeatures)
        at(values, Measure::SqMm) = measured.heightFeatures->sqMm;
    else
        setUndefinedHeight(values, whyNo(context.measured.whyNoHeight(), "press"));
    if (friction)
        at(values, Measure::MeanFriction) = friction->mean;
    else
        setUndefinedFriction(values, whyNo(context.measured.whyNoFriction(), "stroke"));
    return values;
}

}  // namespace study::evaluation
