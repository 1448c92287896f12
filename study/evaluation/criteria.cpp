#include "study/evaluation/criteria.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "study/evaluation/evaluation_text.h"
#include "study/evaluation/summary.h"

namespace study::evaluation {

namespace {

constexpr const char* noSharedFabric = ", on no fabric that both have";

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

/// Two means over the same fabrics: one for which either has no value counts for neither.
struct SharedMeans {
    stats::Value ours, theirs;
    std::string note;  ///< the number of fabrics, where not all count
};

SharedMeans sharedMeans(const PredictorResult& ours, const PredictorResult& theirs, Measure measure)
{
    std::vector<stats::Value> own, others;
    bool isComplete = true;
    for (std::size_t i = 0; i < std::min(ours.fabrics.size(), theirs.fabrics.size()); ++i) {
        const stats::Value &mine = at(ours.fabrics[i].values, measure), &other = at(theirs.fabrics[i].values, measure);
        isComplete = isComplete && mine.exists() == other.exists();
        if (!mine.exists() || !other.exists()) continue;
        own.push_back(mine);
        others.push_back(other);
    }
    if (isComplete || own.empty()) return {at(ours.mean, measure), at(theirs.mean, measure), isComplete ? "" : noSharedFabric};
    return {
        averageOf(measure, own), averageOf(measure, others),
        " (over the " + std::to_string(own.size()) + " of " + std::to_string(ours.fabrics.size()) + " fabrics that have both)"};
}

Criterion againstPredictor(const CriterionRow& row, const PredictorResult& generated, const PredictorResult& other)
{
    const std::string required = "better than: " + other.predictor.name;
    const auto [found, held, note] = sharedMeans(generated, other, row.measure);
    if (!found.exists()) return undefined(row.measure, required, found);
    if (!held.exists())
        return {whatOf(row.measure), required, formattedAs(row.measure, found) + "; the control has no value: " + held.why(),
                std::nullopt};
    const std::string values = formattedAs(row.measure, found) + " to " + formattedAs(row.measure, held) + note;
    if (note == noSharedFabric) return {whatOf(row.measure), required, values, std::nullopt};
    return {whatOf(row.measure), required, values, isBetter(row.measure, *found, *held)};
}

/// Better than another model, which says something about the losses only if both were trained alike.
Criterion againstModel(const CriterionRow& row, const PredictorResult& generated, const PredictorResult& other,
                       const std::string& unfair)
{
    Criterion criterion = againstPredictor(row, generated, other);
    if (unfair.empty()) return criterion;
    criterion.found += "; not a fair control: " + unfair;
    criterion.reached.reset();
    return criterion;
}

/// A photograph of another place does not determine the phase of the texture. Sample by sample, a trace with the right texture
/// is therefore as far off as another measured stroke: this is its noise floor. Only a trace with less texture gets below the
/// error of the fabric's mean, a constant.
Criterion belowMeanOrAtFloor(const CriterionRow& row, const PredictorResult& generated, const Evaluation& evaluation)
{
    const std::string required = "below the fabric's mean, or another stroke's";
    const stats::Value& found = at(generated.mean, row.measure);
    if (!found.exists()) return undefined(row.measure, required, found);
    const SharedMeans mean = sharedMeans(generated, *evaluation.predictor(PredictorKind::FabricMean), row.measure),
                      stroke = sharedMeans(generated, *evaluation.predictor(PredictorKind::AnotherPlace), row.measure);
    const auto canCompare = [](const SharedMeans& one) { return one.theirs.exists() && one.note != noSharedFabric; };
    const bool below = canCompare(mean) && *mean.ours < *mean.theirs,
               atFloor = canCompare(stroke) && *stroke.ours <= *stroke.theirs;
    std::string text = formattedAs(row.measure, found) + " to " + formattedAs(row.measure, mean.theirs) + mean.note + " and " +
                       formattedAs(row.measure, stroke.theirs) + stroke.note;
    text += below ? ": below the mean" : atFloor ? ": at the noise floor of a measured stroke" : "";
    return {whatOf(row.measure), required, text,
            canCompare(mean) || canCompare(stroke) ? std::optional(below || atFloor) : std::nullopt};
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
            criteria.push_back(againstPredictor(row, generated, *evaluation.predictor(row.reference)));
            return;
        case Requirement::BetterThanAgainst:
            for (const PredictorResult& other : evaluation.predictors)
                if (other.predictor.kind == PredictorKind::Against)
                    criteria.push_back(againstModel(row, generated, other, evaluation.whyUnfair(other)));
            return;
        case Requirement::BelowMeanOrAtFloor:
            criteria.push_back(belowMeanOrAtFloor(row, generated, evaluation));
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
