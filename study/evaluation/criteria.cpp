#include "study/evaluation/criteria.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "study/evaluation/evaluation_text.h"

namespace study::evaluation {

namespace {

enum class Requirement {
    AtMost,              ///< the value is at most `low`
    AtLeast,             ///< the value is at least `low`
    MeanAloneAtMost,     ///< the value of the generated mean as a constant is at most `low`
    BetterThan,          ///< better than the control `reference`
    BetterThanAgainst,   ///< better than each of the other models
    BelowMeanOrAtFloor,  ///< below the fabric's mean, or at most the value of another stroke
    EveryFabricWithin,   ///< every fabric from `low` to `high`
};

struct CriterionRow {
    bool bySampleOrLocation, byFabric, onlyAligned;
    Measure measure;
    Requirement requirement;
    double low = 0, high = 0;
    PredictorKind reference = PredictorKind::GlobalConstant;
};

constexpr CriterionRow criterionRows[] = {
    {true, false, false, Measure::MeanFrictionError, Requirement::AtMost, 0.05, 0, {}},
    {true, false, false, Measure::FrictionMaeOverMean, Requirement::AtMost, 0.08, 0, {}},
    {true, false, false, Measure::FrictionMaeOverMean, Requirement::MeanAloneAtMost, 0.08, 0, {}},
    {true, false, false, Measure::FrictionMaeOverMean, Requirement::BelowMeanOrAtFloor, 0, 0, {}},
    {true, false, false, Measure::SsimRegistered, Requirement::BetterThan, 0, 0, PredictorKind::FabricMean},
    {true, false, false, Measure::SsimRegistered, Requirement::BetterThan, 0, 0, PredictorKind::Retrieval},
    {true, false, false, Measure::SsimRegistered, Requirement::BetterThanAgainst, 0, 0, {}},
    {true, false, false, Measure::HeightSpectrum, Requirement::BetterThan, 0, 0, PredictorKind::FabricMean},
    {true, false, false, Measure::HeightSpectrum, Requirement::BetterThan, 0, 0, PredictorKind::Retrieval},
    {true, false, false, Measure::HeightSpectrum, Requirement::BetterThanAgainst, 0, 0, {}},
    {true, false, true, Measure::Ssim, Requirement::AtLeast, 0.45, 0, {}},
    {true, false, false, Measure::SqRatio, Requirement::EveryFabricWithin, 0.8, 1.25, {}},
    {true, false, false, Measure::IdentifiedByBoth, Requirement::AtLeast, 0.90, 0, {}},
    {false, true, false, Measure::MeanFrictionError, Requirement::AtMost, 0.15, 0, {}},
    {false, true, false, Measure::MeanFrictionError, Requirement::BetterThan, 0, 0, PredictorKind::GlobalConstant},
    {false, true, false, Measure::MeanFrictionError, Requirement::BetterThan, 0, 0, PredictorKind::Retrieval},
    {false, true, false, Measure::FrictionMaeOverMean, Requirement::BetterThan, 0, 0, PredictorKind::GlobalConstant},
    {false, true, false, Measure::SsimRegistered, Requirement::BetterThan, 0, 0, PredictorKind::GlobalConstant},
    {false, true, false, Measure::SsimRegistered, Requirement::BetterThan, 0, 0, PredictorKind::Retrieval},
    {false, true, false, Measure::HeightSpectrum, Requirement::BetterThan, 0, 0, PredictorKind::GlobalConstant},
    {false, true, false, Measure::HeightSpectrum, Requirement::BetterThan, 0, 0, PredictorKind::Retrieval},
    {false, true, false, Measure::SqRatio, Requirement::EveryFabricWithin, 0.6, 1.6, {}},
};

bool applies(const CriterionRow& row, const Evaluation& evaluation)
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

std::string formattedAs(Measure measure, const stats::Value& value) { return formatted(value, rowOf(measure).format); }

bool isBetter(Measure measure, double a, double b) { return rowOf(measure).better == Better::Larger ? a > b : a < b; }

Criterion undefined(Measure measure, const std::string& required, const stats::Value& value)
{
    return {whatOf(measure), required, "not defined: " + value.why(), std::nullopt};
}

Criterion againstNumber(const CriterionRow& row, const stats::Value& found)
{
    const bool most = row.requirement == Requirement::AtMost;
    const std::string required = (most ? "at most " : "at least ") + formattedAs(row.measure, row.low);
    if (!found.exists()) return undefined(row.measure, required, found);
    return {whatOf(row.measure), required, formattedAs(row.measure, found), most ? *found <= row.low : *found >= row.low};
}

/// Tests the generated mean as a constant, because the condition h_g&f_g displays only the mean. Sample by sample, a trace with
/// texture has a larger error than its mean.
Criterion meanAlone(const CriterionRow& row, const Evaluation& evaluation)
{
    const PredictorResult* mean = evaluation.predictor(PredictorKind::GeneratedMean);
    CriterionRow number = row;
    number.requirement = Requirement::AtMost;
    Criterion criterion = againstNumber(
        number, mean != nullptr ? at(mean->mean, row.measure) : stats::Value::undefined("there is no generated mean"));
    criterion.what += ", mean alone";
    return criterion;
}

Criterion againstPredictor(const CriterionRow& row, const stats::Value& found, const PredictorResult& other)
{
    const std::string required = "better than: " + other.predictor.name;
    const stats::Value& held = at(other.mean, row.measure);
    if (!found.exists()) return undefined(row.measure, required, found);
    if (!held.exists())
        return {whatOf(row.measure), required, formattedAs(row.measure, found) + "; the control has no value: " + held.why(),
                std::nullopt};
    return {whatOf(row.measure), required, formattedAs(row.measure, found) + " to " + formattedAs(row.measure, held),
            isBetter(row.measure, *found, *held)};
}

/// Better than another model, which says something about the losses only if both were trained alike.
Criterion againstModel(const CriterionRow& row, const stats::Value& found, const PredictorResult& other,
                       const std::string& unfair)
{
    Criterion criterion = againstPredictor(row, found, other);
    if (unfair.empty()) return criterion;
    criterion.found += "; not a fair control: " + unfair;
    criterion.reached.reset();
    return criterion;
}

/// A photograph of another place does not determine the phase of the texture. Sample by sample, a trace with the right texture
/// is therefore as far off as another measured stroke: this is its noise floor. Only a trace with less texture gets below the
/// error of the fabric's mean, a constant.
Criterion belowMeanOrAtFloor(const CriterionRow& row, const stats::Value& found, const Evaluation& evaluation)
{
    const std::string required = "below the fabric's mean, or another stroke's";
    if (!found.exists()) return undefined(row.measure, required, found);
    const stats::Value &mean = at(evaluation.predictor(PredictorKind::FabricMean)->mean, row.measure),
                       &stroke = at(evaluation.predictor(PredictorKind::AnotherPlace)->mean, row.measure);
    const bool below = mean.exists() && *found < *mean, atFloor = stroke.exists() && *found <= *stroke;
    std::string text =
        formattedAs(row.measure, found) + " to " + formattedAs(row.measure, mean) + " and " + formattedAs(row.measure, stroke);
    text += below ? ": below the mean" : atFloor ? ": at the noise floor of a measured stroke" : "";
    return {whatOf(row.measure), required, text,
            mean.exists() || stroke.exists() ? std::optional(below || atFloor) : std::nullopt};
}

Criterion everyFabricWithin(const CriterionRow& row, const PredictorResult& generated)
{
    const std::string required =
        "every fabric from " + formattedAs(row.measure, row.low) + " to " + formattedAs(row.measure, row.high);
    const FabricValues* worst = nullptr;
    const auto off = [&](const FabricValues& fabric) { return std::abs(std::log(*at(fabric.values, row.measure))); };
    bool within = true;
    for (const FabricValues& fabric : generated.fabrics) {
        const stats::Value& value = at(fabric.values, row.measure);
        if (!value.exists()) return undefined(row.measure, required, value);
        within = within && *value >= row.low && *value <= row.high;
        if (worst == nullptr || off(fabric) > off(*worst)) worst = &fabric;
    }
    if (worst == nullptr) return undefined(row.measure, required, stats::Value::undefined("there is no fabric"));
    return {whatOf(row.measure), required,
            "worst " + worst->fabric.value + ": " + formattedAs(row.measure, at(worst->values, row.measure)), within};
}

void addTo(std::vector<Criterion>& criteria, const CriterionRow& row, const Evaluation& evaluation)
{
    const PredictorResult& generated = *evaluation.predictor(PredictorKind::Generated);
    const stats::Value& found = at(generated.mean, row.measure);
    switch (row.requirement) {
        case Requirement::AtMost:
        case Requirement::AtLeast:
            criteria.push_back(againstNumber(row, found));
            return;
        case Requirement::MeanAloneAtMost:
            criteria.push_back(meanAlone(row, evaluation));
            return;
        case Requirement::BetterThan:
            criteria.push_back(againstPredictor(row, found, *evaluation.predictor(row.reference)));
            return;
        case Requirement::BetterThanAgainst:
            for (const PredictorResult& other : evaluation.predictors)
                if (other.predictor.kind == PredictorKind::Against)
                    criteria.push_back(againstModel(row, found, other, evaluation.whyUnfair(other)));
            return;
        case Requirement::BelowMeanOrAtFloor:
            criteria.push_back(belowMeanOrAtFloor(row, found, evaluation));
            return;
        case Requirement::EveryFabricWithin:
            criteria.push_back(everyFabricWithin(row, generated));
            return;
    }
}

}  // namespace

std::vector<Criterion> criteriaOf(const Evaluation& evaluation)
{
    std::vector<Criterion> criteria;
    for (const CriterionRow& row : criterionRows)
        if (applies(row, evaluation)) addTo(criteria, row, evaluation);
    return criteria;
}

}  // namespace study::evaluation
