// The mixed models of a question: condition beside participants and fabrics, so that what is said of
// conditions holds for new ones of both.
#include <algorithm>
#include <cmath>

#include "reports/json/statistic_parts.h"
#include "stats/models/crossed_study.h"

namespace reports {
namespace {

/// Every answer of a question, in the order of participants, conditions and fabrics by name.
stats::CrossedStudy crossedStudyOf(const StudyData& data, const Cells& cells, const std::string& question)
{
    std::vector<std::string> participants, fabrics, conditions;
    stats::CrossedStudy study;
    for (const std::string& condition : data.conditions)
        for (const Response* response : cells.of(question, condition)) {
            participants.push_back(response->participant);
            fabrics.push_back(response->fabric);
            conditions.push_back(condition);
            study.values.push_back(valuesOf({response}).front());
        }
    study.participant = stats::factorOf("participant", participants);
    study.fabric = stats::factorOf("fabric", fabrics);
    study.condition = stats::factorOf("condition", conditions);
    return study;
}

void putLeftOut(Json& part, const std::vector<stats::LeftOut>& leftOut)
{
    for (const stats::LeftOut& effect : leftOut) part["left_out"][effect.name] = effect.why;
}

}  // namespace

Json ratingModelPart(const StudyData& data, const Cells& cells, const std::string& question)
{
    const stats::RatingModel fitted = stats::fitRatings(crossedStudyOf(data, cells, question));
    const stats::MixedModel& model = fitted.model;
    Json part{{"formula", fitted.formula}};
    putLeftOut(part, fitted.leftOut);
    if (!model.why.empty()) {
        putNull(part, "F", model.why);
        return part;
    }
    part["fixef"] = part["se"] = part["var"] = Json::object();
    for (const stats::FixedEffect& effect : model.fixed) {
        put(part["fixef"], effect.name, effect.test.estimate);
        put(part["se"], effect.name, effect.test.se);
    }
    for (const stats::RandomEffect& effect : model.random) put(part["var"], effect.name, effect.variance);
    put(part["var"], "Residual", model.residualVariance);
    put(part, "REML_criterion", model.criterion);
    put(part, "F", fitted.condition.f);
    putWhole(part, "num_df", fitted.condition.df1);
    put(part, "den_df", fitted.condition.df2);
    putP(part, "p", fitted.condition.p, fitted.condition.logP);
    part["singular"] = model.singular;
    part["rows"] = model.rows;
    return part;
}

Json choiceModelPart(const StudyData& data, const Cells& cells, const std::string& question)
{
    const stats::ChoiceModel fitted = stats::fitChoices(crossedStudyOf(data, cells, question));
    const stats::LogisticMixedModel& model = fitted.model;
    Json part{{"method", "Laplace"}, {"formula", fitted.formula}};
    putLeftOut(part, fitted.leftOut);
    if (!model.why.empty()) {
        putNull(part, "lrt_chi2", model.why);
        return part;
    }
    part["fixef"] = part["se"] = Json::object();
    for (const stats::LogOdds& effect : model.fixed) {
        put(part["fixef"], effect.name, effect.estimate);
        put(part["se"], effect.name, effect.se);
    }
    for (const stats::RandomIntercept& effect : model.random) put(part, "sd_" + effect.name, effect.sd);
    put(part, "logLik", model.logLikelihood);
    put(part, "lrt_chi2", model.chiSquared);
    putWhole(part, "lrt_df", model.df);
    putP(part, "lrt_p", model.p, model.logP);
    // R's report says here whether its fit warned; ours says why it would.
    part["warn"] = model.separation != stats::Separation::None;
    if (!model.separationWhy.empty()) part["separation"] = model.separationWhy;
    part["singular"] = model.singular;
    part["rows"] = model.rows;
    return part;
}

}  // namespace reports
