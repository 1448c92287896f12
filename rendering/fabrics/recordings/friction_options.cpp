#include "rendering/fabrics/recordings/friction_options.h"

#include <algorithm>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/fabrics/recordings/import_sources.h"

namespace rendering::fabrics {

Selection selectionFrom(std::string_view text, std::string_view option, TimeInterval& interval)
{
    if (text.empty() || text == "auto") return Selection::Automatic;
    if (text == "none") return Selection::None;
    const auto comma = text.find(',');
    const auto from = protocols::numberIn(text.substr(0, comma));
    const auto to = comma == std::string_view::npos ? std::nullopt : protocols::numberIn(text.substr(comma + 1));
    if (!from || !to || !(*from >= 0 && *from < *to))
        throw protocols::badInput({"\"" + std::string(text) + "\" is not an interval", std::string(option),
                                   "auto, none, or FROM,TO in seconds after the record's start", "correct the option"});
    interval = {*from, *to};
    return Selection::Stated;
}

std::vector<ForceAxis> axesFrom(std::string_view text, std::string_view option, std::size_t most)
{
    std::vector<ForceAxis> axes;
    while (!text.empty()) {
        const auto comma = std::min(text.find(','), text.size());
        std::string_view name = text.substr(0, comma);
        const int sign = name.starts_with('-') ? -1 : 1;
        if (name.starts_with('-') || name.starts_with('+')) name.remove_prefix(1);
        if (name.empty() || axes.size() == most || comma + 1 == text.size())
            throw protocols::badInput({"\"" + std::string(text) + "\" does not name axes", std::string(option),
                                       most == 1 ? "a column such as fz or -fz" : "one or two columns such as fx or fx,-fy",
                                       "correct the option"});
        axes.push_back({std::string(name), sign});
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return axes;
}

std::optional<double> newtonsIn(std::string_view unit)
{
    constexpr double gramForce = 9.80665e-3;
    static constexpr std::pair<std::string_view, double> units[] = {
        {"n", 1},          {"newton", 1},    {"newtons", 1},           {"mn", 1e-3},           {"un", 1e-6}, {"kn", 1e3},
        {"gf", gramForce}, {"g", gramForce}, {"kgf", 1e3 * gramForce}, {"kg", 1e3 * gramForce}};
    const std::string wanted = lowerCase(std::string(unit));
    for (const auto& [name, newtons] : units)
        if (name == wanted) return newtons;
    return std::nullopt;
}

}  // namespace rendering::fabrics
