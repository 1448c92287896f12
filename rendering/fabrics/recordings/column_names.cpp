#include "rendering/fabrics/recordings/column_names.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "rendering/fabrics/recordings/import_sources.h"

namespace rendering::fabrics {

NameAndUnit nameAndUnit(const std::string& header)
{
    std::string text = lowerCase(header);
    std::replace(text.begin(), text.end(), ' ', '_');
    if (text == "f_n") return {text, ""};  // The normal force, not a quantity f in newtons.
    const auto open = text.find_first_of("([");
    if (open != std::string::npos) {
        const auto close = text.find_first_of(")]", open);
        std::string name = text.substr(0, open);
        while (!name.empty() && name.back() == '_') name.pop_back();
        std::string unit = text.substr(open + 1, close == std::string::npos ? close : close - open - 1);
        while (!unit.empty() && unit.back() == '_') unit.pop_back();
        unit.erase(0, std::min(unit.find_first_not_of('_'), unit.size()));
        return {name, unit};
    }
    const auto last = text.rfind('_');
    if (last != std::string::npos)
        for (const std::string_view unit :
             {"s", "sec", "seconds", "ms", "us", "ns", "n", "mn", "un", "kn", "g", "gf", "kg", "kgf"})
            if (text.substr(last + 1) == unit) return {text.substr(0, last), std::string(unit)};
    return {text, ""};
}

bool isCalled(const std::string& header, const std::string& wanted)
{
    if (lowerCase(header) == lowerCase(wanted)) return true;
    std::string name = lowerCase(wanted);
    std::replace(name.begin(), name.end(), ' ', '_');
    return nameAndUnit(header).name == name;
}

double newtonsOf(const std::string& header, const FrictionOptions& options, const std::string& where)
{
    const std::string stated = nameAndUnit(header).unit, unit = stated.empty() ? options.forceUnit : stated;
    if (unit.empty()) return 1;
    if (const auto newtons = newtonsIn(unit)) return *newtons;
    throw protocols::badInput(
        {"the unit of the column \"" + header + "\" is unknown", where, std::string(knownForceUnits), "rename the column"});
}

std::string meaningOf(const std::vector<std::string>& tangential, const std::string& normal)
{
    const std::string force =
        tangential.size() == 2 ? "sqrt(" + tangential[0] + "^2 + " + tangential[1] + "^2)" : tangential.at(0);
    return "coefficient of friction = " + force + " / " + normal;
}

}  // namespace rendering::fabrics
