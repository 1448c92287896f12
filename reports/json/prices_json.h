// The prices of a study's renderings in JSON: a study keeps them as text, and results.json shows them as parts of its chain.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/data/rendering_price.h"

namespace reports {

/// Condition, quality, settings and all measures.
nlohmann::ordered_json priceJson(const RenderingPrice& price);

/// An array of priceJson(). Empty for null. Throws workFailed for anything else.
std::vector<RenderingPrice> pricesFromJson(const nlohmann::ordered_json& prices);

}  // namespace reports
