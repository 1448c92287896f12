#include "stats/models/crossed_study.h"

#include <cmath>

namespace stats {
namespace {

/// The rows that have a value; conditions without any are added to `leftOut`.
CrossedStudy present(const CrossedStudy& study, std::vector<LeftOut>& leftOut)
{
    std::vector<std::size_t> rows;
    std::vector<bool> answered(study.condition.levels.size());
    for (std::size_t row = 0; row < study.values.size(); ++row) {
        if (std::isnan(study.values[row])) continue;
        rows.push_back(row);
        answered[study.condition.of[row]] = true;
    }
    for (std::size_t c = 0; c < answered.size(); ++c)
        if (!answered[c]) leftOut.push_back({study.condition.levels[c], "has no values"});
    CrossedStudy result{rowsOf(study.participant, rows), rowsOf(study.fabric, rows), rowsOf(study.condition, rows), {}};
    for (const std::size_t row : rows) result.values.push_back(study.values[row]);
    return result;
}

constexpr const char* oneLevelOnly = "has one level only";

/// The reason why the variance between the levels of a group cannot be estimated; empty where it can.
std::string reasonAgainst(const Factor& group, std::size_t rows)
{
    if (group.levels.size() < 2) return oneLevelOnly;
    if (group.levels.size() >= rows) return "has a level for every value, as the residual";
    return {};
}

/// Keeps the groups whose variance can be estimated and lists the others.
class Groups {
public:
    Groups(std::size_t rows, std::vector<LeftOut>& leftOut) : m_rows(rows), m_leftOut(leftOut) {}

    /// False, with its reason, where the group is left out.
    bool add(const Factor& group)
    {
        const std::string why = reasonAgainst(group, m_rows);
        if (why.empty())
            m_kept.push_back(group);
        else
            m_leftOut.push_back({group.name, why});
        return why.empty();
    }
    void leaveOut(const std::string& name, const std::string& why) { m_leftOut.push_back({name, why}); }
    const std::vector<Factor>& kept() const { return m_kept; }

private:
    std::size_t m_rows;
    std::vector<LeftOut>& m_leftOut;
    std::vector<Factor> m_kept;
};

std::string formulaOf(const std::string& response, const std::vector<Factor>& groups)
{
    std::string formula = response + "~condition";
    for (const Factor& group : groups) formula += "+(1|" + group.name + ")";
    return formula;
}

Factor named(Factor factor, const char* name)
{
    factor.name = name;
    return factor;
}

CrossedStudy named(CrossedStudy study)
{
    return {named(std::move(study.participant), "participant"), named(std::move(study.fabric), "fabric"),
            named(std::move(study.condition), "condition"), std::move(study.values)};
}

/// Participant, fabric and their interactions with condition, as far as the data allow.
void addCrossedGroups(Groups& groups, const CrossedStudy& study)
{
    const bool compared = study.condition.levels.size() > 1;
    std::vector<Factor> interactions;
    for (const Factor& group : {study.participant, study.fabric}) {
        const std::string interaction = group.name + ":condition";
        if (!groups.add(group))
            groups.leaveOut(interaction, group.name + " was left out");
        else if (!compared)
            groups.leaveOut(interaction, "there is one condition only");
        else
            interactions.push_back(interactionOf(group, study.condition));
    }
    for (const Factor& interaction : interactions) groups.add(interaction);
}

}  // namespace

RatingModel fitRatings(const CrossedStudy& whole, const MixedModelOptions& options)
{
    RatingModel result;
    const CrossedStudy study = named(present(whole, result.leftOut));
    Groups groups(study.values.size(), result.leftOut);
    addCrossedGroups(groups, study);
    result.formula = formulaOf("y", groups.kept());
    result.conditions = study.condition.levels;
    MixedModelData data{study.values, treatmentCoded(study.condition), {}};
    for (const Factor& group : groups.kept()) data.random.push_back({group, {}, ""});
    result.model = fitMixedModel(data, options);
    result.model.missing = whole.values.size() - study.values.size();
    result.condition = effectTest(result.model);
    return result;
}

std::string whyNotForOthers(const std::vector<LeftOut>& leftOut)
{
    for (const LeftOut& effect : leftOut)
        if (effect.why == oneLevelOnly && (effect.name == "fabric" || effect.name == "participant"))
            return "there is one " + effect.name + " only: a result for fabrics like these needs at least 2";
    return {};
}

FTest conditionForOthers(const RatingModel& model)
{
    const std::string why = whyNotForOthers(model.leftOut);
    if (why.empty()) return model.condition;
    const Value none = Value::undefined(why);
    return {why, none, none, none, none, none};
}

OrdinalRatingModel fitOrdinal(const CrossedStudy& whole, const OrdinalOptions& options)
{
    OrdinalRatingModel result;
    const CrossedStudy study = named(present(whole, result.leftOut));
    Groups groups(study.values.size(), result.leftOut);
    groups.add(study.participant);
    groups.add(study.fabric);
    result.formula = formulaOf("rounded", groups.kept());
    result.conditions = study.condition.levels;
    result.model = fitOrdinalMixedModel({study.values, study.condition, groups.kept()}, options);
    result.model.missing = whole.values.size() - study.values.size();
    return result;
}

ChoiceModel fitChoices(const CrossedStudy& whole, ChoiceTerms terms, double confidence)
{
    ChoiceModel result;
    const CrossedStudy study = named(present(whole, result.leftOut));
    Groups groups(study.values.size(), result.leftOut);
    if (terms == ChoiceTerms::WithInteractions)
        addCrossedGroups(groups, study);
    else {
        groups.add(study.participant);
        groups.add(study.fabric);
    }
    result.formula = formulaOf("correct", groups.kept());
    result.conditions = study.condition.levels;
    result.model =
        fitLogisticMixedModel({study.values, study.condition, groups.kept()},
                              {confidence, terms == ChoiceTerms::WithInteractions ? Curvature::AtTheMode : Curvature::AtOneStep});
    result.model.missing = whole.values.size() - study.values.size();
    return result;
}

}  // namespace stats
