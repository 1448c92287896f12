#include "study/evaluation/criteria.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "study/evaluation/evaluation_text.h"

namespace study::evaluation {

namespace {

enum class Asked {
    AtMost,           ///< a number
    AtLeast,          ///< a number
    MeanAloneAtMost,  ///< a number; of the generated mean as a constant
    BetterThan,       ///< a control
    BetterThanAgainst,
    BelowMeanOrAtFloor,
    EveryFabricWithin,
};

struct Row {
    bool bySampleOrLocation, byFabric, onlyAligned;
    Measure measure;
    Asked asked;
    double low = 0, high = 0;                        ///< EveryFabricWithin; low alone: AtMost, AtLeast
    SpeakerKind than = SpeakerKind::GlobalConstant;  ///< BetterThan
};

constexpr Row rows[] = {
    {true, false, false, Measure::MeanFrictionError, Asked::AtMost, 0.05, 0, {}},
    {true, false, false, Measure::FrictionMaeOverMean, Asked::AtMost, 0.08, 0, {}},
    {true, false, false, Measure::FrictionMaeOverMean, Asked::MeanAloneAtMost, 0.08, 0, {}},
    {true, false, false, Measure::FrictionMaeOverMean, Asked::BelowMeanOrAtFloor, 0, 0, {}},
    {true, false, false, Measure::SsimRegistered, Asked::BetterThan, 0, 0, SpeakerKind::FabricMean},
    {true, false, false, Measure::SsimRegistered, Asked::BetterThan, 0, 0, SpeakerKind::Retrieval},
    {true, false, false, Measure::SsimRegistered, Asked::BetterThanAgainst, 0, 0, {}},
    {true, false, false, Measure::HeightSpectrum, Asked::BetterThan, 0, 0, SpeakerKind::FabricMean},
    {true, false, false, Measure::HeightSpectrum, Asked::BetterThan, 0, 0, SpeakerKind::Retrieval},
    {true, false, false, Measure::HeightSpectrum, Asked::BetterThanAgainst, 0, 0, {}},
    {true, false, true, Measure::Ssim, Asked::AtLeast, 0.45, 0, {}},
    {true, false, false, Measure::SqRatio, Asked::EveryFabricWithin, 0.8, 1.25, {}},
    {true, false, false, Measure::IdentifiedByBoth, Asked::AtLeast, 0.90, 0, {}},
    {false, true, false, Measure::MeanFrictionError, Asked::AtMost, 0.15, 0, {}},
    {false, true, false, Measure::MeanFrictionError, Asked::BetterThan, 0, 0, SpeakerKind::GlobalConstant},
    {false, true, false, Measure::MeanFrictionError, Asked::BetterThan, 0, 0, SpeakerKind::Retrieval},
    {false, true, false, Measure::FrictionMaeOverMean, Asked::BetterThan, 0, 0, SpeakerKind::GlobalConstant},
    {false, true, false, Measure::SsimRegistered, Asked::BetterThan, 0, 0, SpeakerKind::GlobalConstant},
    {false, true, false, Measure::SsimRegistered, Asked::BetterThan, 0, 0, SpeakerKind::Retrieval},
    {false, true, false, Measure::HeightSpectrum, Asked::BetterThan, 0, 0, SpeakerKind::GlobalConstant},
    {false, true, false, Measure::HeightSpectrum, Asked::BetterThan, 0, 0, SpeakerKind::Retrieval},
    {false, true, false, Measure::SqRatio, Asked::EveryFabricWithin, 0.6, 1.6, {}},
};

bool applies(const Row& row, const Evaluation& evaluation)
{
    return (evaluation.split == SplitKind::Fabric ? row.byFabric : row.bySampleOrLocation) &&
           (!row.onlyAligned || evaluation.aligned);
}

std::string whatOf(Measure measure)
{
    switch (rowOf(measure).section) {
        case Section::Friction:
            return "friction: " + std::string(rowOf(measure).heading);
        case Section::Height:
            return "height: " + std::string(rowOf(measure).heading);
        case Section::Roughness:
            return "roughness: ratio of " + std::string(rowOf(measure).heading);
        case Section::Identification:
            return "identified " + std::string(rowOf(measure).heading);
        case Section::Level:
            break;
    }
    return std::string(rowOf(measure).heading);
}

std::string shownBy(Measure measure, const stats::Value& value) { return shownValue(value, rowOf(measure).shown); }

bool isBetter(Measure measure, double a, double b) { return rowOf(measure).better == Better::Larger ? a > b : a < b; }

Criterion undefined(Measure measure, const std::string& asked, const stats::Value& value)
{
    return {whatOf(measure), asked, "not defined: " + value.why(), std::nullopt};
}

Criterion againstNumber(const Row& row, const stats::Value& found)
{
    const bool most = row.asked == Asked::AtMost;
    const std::string asked = (most ? "at most " : "at least ") + shownBy(row.measure, row.low);
    if (!found.exists()) return undefined(row.measure, asked, found);
    return {whatOf(row.measure), asked, shownBy(row.measure, found), most ? *found <= row.low : *found >= row.low};
}

/// The condition h_g&f_g shows the mean alone; a trace with texture lies farther off, sample by sample, the better its texture.
Criterion meanAlone(const Row& row, const Evaluation& evaluation)
{
    const SpeakerResult* mean = evaluation.speaker(SpeakerKind::GeneratedMean);
    Row number = row;
    number.asked = Asked::AtMost;
    Criterion criterion =
        againstNumber(number, mean != nullptr ? at(mean->mean, row.measure) : stats::Value::undefined("there is no mean alone"));
    criterion.what += ", mean alone";
    return criterion;
}

Criterion againstSpeaker(const Row& row, const stats::Value& found, const SpeakerResult& other)
{
    const std::string asked = "better than: " + other.speaker.name;
    const stats::Value& held = at(other.mean, row.measure);
    if (!found.exists()) return undefined(row.measure, asked, found);
    if (!held.exists())
        return {whatOf(row.measure), asked, shownBy(row.measure, found) + "; the other has none: " + held.why(), std::nullopt};
    return {whatOf(row.measure), asked, shownBy(row.measure, found) + " to " + shownBy(row.measure, held),
            isBetter(row.measure, *found, *held)};
}

/// A trace with the right texture lies, sample by sample, as far off as another stroke of the fabric does: the phase of the
/// texture follows from no photograph of another place. That is its noise floor; below the fabric's mean, a constant, only less
/// texture gets it.
Criterion belowMeanOrAtFloor(const Row& row, const stats::Value& found, const Evaluation& evaluation)
{
    const std::string asked = "below the fabric's mean, or another stroke's";
    if (!found.exists()) return undefined(row.measure, asked, found);
    const stats::Value &mean = at(evaluation.speaker(SpeakerKind::FabricMean)->mean, row.measure),
                       &stroke = at(evaluation.speaker(SpeakerKind::AnotherPlace)->mean, row.measure);
    const bool below = mean.exists() && *found < *mean, atFloor = stroke.exists() && *found <= *stroke;
    std::string text = shownBy(row.measure, found) + " to " + shownBy(row.measure, mean) + " and " + shownBy(row.measure, stroke);
    text += below ? ": below the mean" : atFloor ? ": at the noise floor of a measured stroke" : "";
    return {whatOf(row.measure), asked, text, mean.exists() || stroke.exists() ? std::optional(below || atFloor) : std::nullopt};
}

Criterion everyFabricWithin(const Row& row, const SpeakerResult& generated)
{
    const std::string asked = "every fabric from " + shownBy(row.measure, row.low) + " to " + shownBy(row.measure, row.high);
    const FabricValues* worst = nullptr;
    const auto off = [&](const FabricValues& fabric) { return std::abs(std::log(*at(fabric.values, row.measure))); };
    bool within = true;
    for (const FabricValues& fabric : generated.fabrics) {
        const stats::Value& value = at(fabric.values, row.measure);
        if (!value.exists()) return undefined(row.measure, asked, value);
        within = within && *value >= row.low && *value <= row.high;
        if (worst == nullptr || off(fabric) > off(*worst)) worst = &fabric;
    }
    if (worst == nullptr) return undefined(row.measure, asked, stats::Value::undefined("there is no fabric"));
    return {whatOf(row.measure), asked,
            "worst " + worst->fabric.value + ": " + shownBy(row.measure, at(worst->values, row.measure)), within};
}

void addTo(std::vector<Criterion>& criteria, const Row& row, const Evaluation& evaluation)
{
    const SpeakerResult& generated = *evaluation.speaker(SpeakerKind::Generated);
    const stats::Value& found = at(generated.mean, row.measure);
    switch (row.asked) {
        case Asked::AtMost:
        case Asked::AtLeast:
            criteria.push_back(againstNumber(row, found));
            return;
        case Asked::MeanAloneAtMost:
            criteria.push_back(meanAlone(row, evaluation));
            return;
        case Asked::BetterThan:
            criteria.push_back(againstSpeaker(row, found, *evaluation.speaker(row.than)));
            return;
        case Asked::BetterThanAgainst:
            for (const SpeakerResult& other : evaluation.speakers)
                if (other.speaker.kind == SpeakerKind::Against) criteria.push_back(againstSpeaker(row, found, other));
            return;
        case Asked::BelowMeanOrAtFloor:
            criteria.push_back(belowMeanOrAtFloor(row, found, evaluation));
            return;
        case Asked::EveryFabricWithin:
            criteria.push_back(everyFabricWithin(row, generated));
            return;
    }
}

}  // namespace

std::vector<Criterion> criteriaOf(const Evaluation& evaluation)
{
    std::vector<Criterion> criteria;
    for (const Row& row : rows)
        if (applies(row, evaluation)) addTo(criteria, row, evaluation);
    return criteria;
}

}  // namespace study::evaluation
