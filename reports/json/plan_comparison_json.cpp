#include "reports/json/plan_comparison_json.h"

#include <nlohmann/json.hpp>

#include "reports/json/json_fields.h"

namespace reports {
namespace {

Json amendmentRow(const Registration& registration)
{
    return {{"number", registration.number},
            {"time", registration.time},
            {"sha256", registration.sha256},
            {"answers_before", registration.answersBefore},
            {"after_unblinding", registration.afterUnblinding},
            {"changes", registration.changes}};
}

void putRegistration(Json& part, const StudyData& data)
{
    if (!data.registrations.empty()) {
        const Registration& first = data.registrations.front();
        part["time"] = first.time;
        part["sha256"] = first.sha256;
        part["answers_before"] = first.answersBefore;
        part["after_unblinding"] = first.afterUnblinding;
        for (const Registration& registration : data.registrations)
            if (registration.isFollowed) part["followed"] = registration.number;
        if (data.planVersion > 0)
            putNull(part, "followed", "the registered plan changes what the protocol stated before the first answer");
        return;
    }
    const std::string why = data.hasLog ? "the study was not preregistered" : "the answers came without a registration";
    for (const char* field : {"time", "sha256", "answers_before", "after_unblinding", "followed"}) putNull(part, field, why);
}

}  // namespace

nlohmann::ordered_json preregistrationJson(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    Json part{{"registered", !data.registrations.empty()}};
    putRegistration(part, data);
    if (data.planVersion > 0) part["protocol_version"] = data.planVersion;
    part["amendments"] = Json::array();
    for (std::size_t i = 1; i < data.registrations.size(); ++i) part["amendments"].push_back(amendmentRow(data.registrations[i]));
    if (data.plannedDesign) {
        part["deviations"] = Json::array();
        for (const PlanRow& row : deviationsOf(analysis.plan))
            part["deviations"].push_back({{"item", row.item}, {"planned", row.planned}, {"done", row.done}});
        part["contrasts_not_tested"] = Json::array();
        for (const ContrastDone& contrast : analysis.plan.contrasts)
            if (contrast.testedIn.empty())
                part["contrasts_not_tested"].push_back({{"a", contrast.a}, {"b", contrast.b}, {"reason", contrast.why}});
    } else {
        for (const char* field : {"deviations", "contrasts_not_tested"}) putNull(part, field, "no plan is known");
    }
    putReasonsLast(part);
    return part;
}

}  // namespace reports
