// Speed and accuracy, and effects of order, as parts of statistics.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/analysis/accuracy_by_speed.h"
#include "reports/analysis/order_effects.h"
#include "reports/analysis/speed_analysis.h"
#include "reports/json/json_fields.h"

namespace reports {

/// "q1_speed_accuracy_contrasts": one row for each contrast and measure, for these fabrics.
Json speedContrastsJson(const SpeedAnalysis& speed);

/// "q1_conditional_accuracy": bins over all conditions and by condition, and the trend with the response time.
Json accuracyBySpeedJson(const std::vector<std::string>& conditions, const AccuracyBySpeed& accuracy);

/// "order_effects": trends over trials and sittings by question, and a contrast with and without the trend.
Json orderEffectsJson(const OrderEffects& effects);

/// "trend_per_10_trials" and so on.
std::string keyOf(OrderEffectKind kind);

}  // namespace reports
