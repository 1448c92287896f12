// One test pair at a time: what each speaker says of it, and how far that lies from what was measured.
#pragma once

#include <memory>

#include "study/evaluation/controls.h"
#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// What a pair's partners were measured to be; maps are read again when they are needed, features are kept.
struct MeasuredPair {
    std::optional<HeightFeatures> heightFeatures;
    double lowestMm = 0, highestMm = 0;
    std::optional<Trace> trace;
};

/// What all pairs are measured with.
struct Setting {
    const rendering::fabrics::Dataset& dataset;
    const MeasuredSignals& measured;
    const TestPlan& plan;
    const Controls& controls;
};

MeasuredPair measurePair(const Setting& setting, const TestPair& pair);

/// A speaker's words: no height or trace where it has none, with the reason.
struct Said {
    std::optional<HeightMap> height;
    std::optional<Trace> trace;
    std::string whyNoHeight, whyNoTrace;
};

Said saidByModel(const Setting& setting, const TestPair& pair, const rendering::models::GeneratedSignals& generated);
/// The generated mean friction, as a constant.
Said saidByMean(const rendering::models::GeneratedSignals& generated, const MeasuredPair& measured);
Said saidByControl(const Setting& setting, SpeakerKind kind, std::size_t pair, const MeasuredPair& measured);

/// All measures of one speaker on one pair. `partner`: the measured map, empty where there is none.
Values compare(const Setting& setting, const TestPair& pair, const MeasuredPair& measured, const HeightMap& partner,
               const Said& said, double rangeMm);
/// The measured pair itself before the judge: the ceiling of identification, and the measured means.
Values measuredItself(const Setting& setting, const TestPair& pair, const MeasuredPair& measured);

/// The measured map of the pair's press, at its pitch; empty where there is none.
HeightMap partnerMap(const Setting& setting, const TestPair& pair);

}  // namespace study::evaluation
