// The "signals" object of results.json, which a study keeps as text: read once into a value, and written from it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "reports/data/signal_comparison.h"

namespace reports {

/// None for an empty text and for "{}": no signals belong to the study. Throws workFailed where it is no such object.
std::optional<SignalComparison> signalsFromJson(const std::string& text);

nlohmann::ordered_json signalsJson(const SignalComparison& signals);

}  // namespace reports
