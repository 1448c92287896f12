#include "study/evaluation/speaking.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace study::evaluation {

namespace {

HeightMap mapOf(const Setting& setting, const Sample& press)
{
    return {setting.measured.height(press.fabric, press.index), setting.measured.pitchMm(), press.rotationDeg.value_or(0)};
}

Trace traceOf(const Setting& setting, const Sample& stroke)
{
    const auto trace = setting.measured.trace(stroke.fabric, stroke.index);
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
    if (!found) return stats::Value::undefined("fewer than two fabrics to tell apart, or a signal too small to describe");
    return *found == fabric ? 1 : 0;
}

void identify(const Setting& setting, const TestPair& pair, const std::optional<HeightFeatures>& height,
              const std::optional<FrictionFeatures>& friction, Values& values)
{
    const Judge& judge = *setting.controls.judge;
    FeatureVector both;
    if (height) {
        both = featureVector(*height);
        at(values, Measure::IdentifiedByHeight) = identified(judge.byHeight, both, pair.fabric);
    }
    if (friction) {
        const FeatureVector features = featureVector(*friction);
        at(values, Measure::IdentifiedByFriction) = identified(judge.byFriction, features, pair.fabric);
        both.insert(both.end(), features.begin(), features.end());
    }
    if (height && friction) at(values, Measure::IdentifiedByBoth) = identified(judge.byBoth, both, pair.fabric);
}

std::string whyNo(const std::string& dataset, const char* partner)
{
    return dataset.empty() ? std::string("no measured ") + partner + " of the fabric is left to compare with" : dataset;
}

/// What another sample of the data set says.
Said saidBySamples(const Setting& setting, const std::optional<Sample>& press, const std::optional<Sample>& stroke,
                   const std::string& why)
{
    Said said;
    said.whyNoHeight = said.whyNoTrace = why;
    if (press && setting.measured.whyNoHeight().empty()) said.height = mapOf(setting, *press);
    if (stroke && setting.measured.whyNoFriction().empty()) said.trace = traceOf(setting, *stroke);
    return said;
}

/// The retrieved press, laid as the retrieved photograph lies: which way the fabric lies in a photograph that it is asked
/// for, retrieval does not know. So it is off by as much as the two photographs are turned against each other.
Said saidByNeighbour(const Setting& setting, const Sample& asked, const Retrieved& found)
{
    Said said =
        saidBySamples(setting, found.press, found.stroke, "the training part holds no such sample of the retrieved fabric");
    if (said.height && asked.rotationDeg && found.photograph.rotationDeg)
        said.height->rotationDeg += *asked.rotationDeg - *found.photograph.rotationDeg;
    return said;
}

Said saidByConstants(const Setting& setting, const TestPair& pair, const MeasuredPair& measured, const stats::Value& heightMm,
                     const stats::Value& friction)
{
    Said said;
    said.whyNoHeight = heightMm.why();
    said.whyNoTrace = friction.why();
    if (heightMm.exists() && measured.heightFeatures) said.height = flat(partnerMap(setting, pair), *heightMm);
    if (friction.exists() && measured.trace) said.trace = constantTrace(*friction, measured.trace->values.size());
    return said;
}

}  // namespace

MeasuredPair measurePair(const Setting& setting, const TestPair& pair)
{
    MeasuredPair measured;
    if (pair.press && setting.measured.whyNoHeight().empty()) {
        const HeightMap map = mapOf(setting, *pair.press);
        measured.heightFeatures = heightFeatures(map, setting.controls.featureSide);
        cv::minMaxLoc(map.heightMm, &measured.lowestMm, &measured.highestMm);
    }
    if (pair.stroke && setting.measured.whyNoFriction().empty()) measured.trace = traceOf(setting, *pair.stroke);
    return measured;
}

HeightMap partnerMap(const Setting& setting, const TestPair& pair)
{
    return pair.press && setting.measured.whyNoHeight().empty() ? mapOf(setting, *pair.press) : HeightMap{};
}

Said saidByModel(const Setting& setting, const TestPair& pair, const rendering::models::GeneratedSignals& generated)
{
    Said said;
    const double pitch = setting.dataset.tactileMmPerPixel ? generated.heightMmPerPixel : setting.measured.pitchMm();
    said.height = atPitch({generated.heightMm, pitch, pair.photograph.rotationDeg.value_or(0)}, setting.measured.pitchMm());
    said.trace = Trace{generated.trace, generated.traceMmPerSample};
    return said;
}

Said saidByMean(const rendering::models::GeneratedSignals& generated, const MeasuredPair& measured)
{
    Said said;
    said.whyNoHeight = "it speaks of friction alone";
    if (measured.trace) said.trace = constantTrace(generated.meanFriction, measured.trace->values.size());
    return said;
}

Said saidByControl(const Setting& setting, SpeakerKind kind, std::size_t number, const MeasuredPair& measured)
{
    const TestPair& pair = setting.plan.pairs[number];
    const Controls& controls = setting.controls;
    switch (kind) {
        case SpeakerKind::GlobalConstant:
            return saidByConstants(setting, pair, measured, controls.heightMm, controls.friction);
        case SpeakerKind::FabricMean:
            return saidByConstants(setting, pair, measured, controls.heightMmOfFabric[pair.fabric],
                                   controls.frictionOfFabric[pair.fabric]);
        case SpeakerKind::Retrieval:
            if (controls.retrieved.empty()) return saidBySamples(setting, {}, {}, controls.whyNothingRetrieved);
            return saidByNeighbour(setting, pair.photograph, controls.retrieved[number]);
        case SpeakerKind::AnotherPlace:
            return saidBySamples(setting, pair.otherPress, pair.otherStroke, "the fabric has no second sample of the signal");
        case SpeakerKind::Generated:
        case SpeakerKind::GeneratedMean:
        case SpeakerKind::Against:
        case SpeakerKind::Measured:
            break;
    }
    return {};
}

Values compare(const Setting& setting, const TestPair& pair, const MeasuredPair& measured, const HeightMap& partner,
               const Said& said, double rangeMm)
{
    Values values;
    std::optional<HeightFeatures> height;
    std::optional<FrictionFeatures> friction;
    if (said.height && !partner.heightMm.empty()) {
        height = heightFeatures(*said.height, setting.controls.featureSide);
        compareHeights(*said.height, *height, partner, *measured.heightFeatures, rangeMm, values);
    }
    if (said.trace && measured.trace) {
        const Trace trace = atSpacing(*said.trace, measured.trace->mmPerSample);
        friction = frictionFeatures(trace);
        compareTraces(trace, *measured.trace, values);
    }
    identify(setting, pair, height, friction, values);
    if (!height)
        setUndefinedHeight(values, measured.heightFeatures ? said.whyNoHeight : whyNo(setting.measured.whyNoHeight(), "press"));
    if (!friction)
        setUndefinedFriction(values, measured.trace ? said.whyNoTrace : whyNo(setting.measured.whyNoFriction(), "stroke"));
    return values;
}

Values measuredItself(const Setting& setting, const TestPair& pair, const MeasuredPair& measured)
{
    Values values;
    for (const Section section : {Section::Friction, Section::Height, Section::Roughness})
        setUndefined(values, section, "what is compared with");
    std::optional<FrictionFeatures> friction;
    if (measured.trace) friction = frictionFeatures(*measured.trace);
    identify(setting, pair, measured.heightFeatures, friction, values);
    if (measured.heightFeatures)
        at(values, Measure::SqMm) = measured.heightFeatures->sqMm;
    else
        setUndefinedHeight(values, whyNo(setting.measured.whyNoHeight(), "press"));
    if (friction)
        at(values, Measure::MeanFriction) = friction->mean;
    else
        setUndefinedFriction(values, whyNo(setting.measured.whyNoFriction(), "stroke"));
    return values;
}

}  // namespace study::evaluation
