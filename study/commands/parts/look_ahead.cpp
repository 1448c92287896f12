#include "study/commands/parts/look_ahead.h"

#include <nlohmann/json.hpp>

#include "study/making/session_plan.h"

namespace study::commands {

app::SessionOutlook lookAhead(const protocols::Protocol& protocol)
{
    const auto plan = making::sessionPlan(protocol);
    app::SessionOutlook outlook;
    for (const auto& range : plan.at("balance"))
        outlook.balance.push_back({range.at("what").get<std::string>(), range.at("min").get<int>(), range.at("max").get<int>()});
    for (const auto& row : plan.at("detects")) {
        app::SessionOutlook::Detectable one{row.at("question").get<std::string>(), row.at("unit") == "scale points", {}, {}};
        if (row.at("smallest").is_number())
            one.smallest = row.at("smallest").get<double>();
        else
            one.why = row.value("why", std::string());
        outlook.detects.push_back(one);
    }
    return outlook;
}

}  // namespace study::commands
