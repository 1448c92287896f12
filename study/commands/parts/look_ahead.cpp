#include "study/commands/parts/look_ahead.h"

#include <nlohmann/json.hpp>

#include "protocols/orders/counterbalancing.h"
#include "protocols/records/balance.h"
#include "study/making/session_plan.h"

namespace study::commands {

namespace {

/// Presentations of all participants whose orders are drawn within about two seconds.
constexpr int mostDrawn = 2500;
constexpr std::uint64_t drawnSeed = 1;  // as `protocol show` has it

}  // namespace

app::SessionOutlook lookAhead(const protocols::Protocol& protocol)
{
    app::SessionOutlook outlook;
    for (const auto& row : making::detectableEffects(protocol)) {
        app::SessionOutlook::Detectable one{row.at("question").get<std::string>(), row.at("unit") == "scale points", {}, {}};
        if (row.at("smallest").is_number())
            one.smallest = row.at("smallest").get<double>();
        else
            one.why = row.at("why").at("smallest").get<std::string>();
        outlook.detects.push_back(one);
    }
    outlook.isBalanceDrawn = protocol.presentations() * static_cast<long long>(protocol.participants) <= mostDrawn;
    if (!outlook.isBalanceDrawn) return outlook;
    const auto balance = protocols::jsonOf(protocols::balanceOf(protocols::drawDesign(protocol, drawnSeed), protocol));
    for (const auto& range : balance.at("balance"))
        outlook.balance.push_back({range.at("what").get<std::string>(), range.at("min").get<int>(), range.at("max").get<int>()});
    return outlook;
}

}  // namespace study::commands
