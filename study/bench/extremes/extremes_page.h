// The extremes as text, JSON and a page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/bench/extremes/extreme_case.h"

namespace study::bench {

/// One line a case, and one sentence on each other program.
std::string extremesText(const std::vector<ExtremeResult>& results);

nlohmann::ordered_json extremesJson(const std::vector<ExtremeResult>& results, const std::string& machine);

/// One self-contained page (HTML), readable on a phone; light or dark as the reader's system is. `peers`: other programs were
/// asked, so that those without an answer are not installed.
std::string extremesPage(const std::vector<ExtremeResult>& results, const std::string& machine, bool peers);

/// "15.3 digits", "refused, as it must", "wrong: 0.015": what an answer is worth.
std::string worthOf(const ExtremeAnswer& answer, const ExtremeCase& asked);

}  // namespace study::bench
