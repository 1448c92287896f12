// A leak report as text for people and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/leaks/leak_report.h"

namespace study::leaks {

/// The object of `leak-check --json`, schema vis2hap.leak-check/1.
nlohmann::ordered_json jsonOf(const LeakReport& report);

/// The best guesser of each attack, the findings, and a verdict for each role.
std::string textOf(const LeakReport& report);

}  // namespace study::leaks
