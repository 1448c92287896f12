// Headers of columns in friction records: name, unit and factor to newtons.
#pragma once

#include <string>
#include <vector>

#include "rendering/fabrics/recordings/friction_options.h"

namespace rendering::fabrics {

/// Name and unit in a header such as "Fn [mN]", "fx_N" or "time_ms", in lower case.
struct NameAndUnit {
    std::string name, unit;
};
NameAndUnit nameAndUnit(const std::string& header);

/// Whether a user who names `wanted` means the column: its header with or without its unit, in any letter case.
bool isCalled(const std::string& header, const std::string& wanted);

/// Newtons per unit of a column: the unit in its header, else the one in the options. Throws badInput for an unknown unit.
double newtonsOf(const std::string& header, const FrictionOptions& options, const std::string& where);

/// Text "coefficient of friction = ..." for one tangential axis, or for two that are combined.
std::string meaningOf(const std::vector<std::string>& tangential, const std::string& normal);

}  // namespace rendering::fabrics
