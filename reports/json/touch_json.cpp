#include "reports/json/touch_json.h"

#include <nlohmann/json.hpp>

namespace reports {
namespace {

Json quantityPart(const TouchQuantity& quantity)
{
    Json part{{"presentations", quantity.presentations}, {"participants", quantity.participants}};
    put(part, "median", quantity.median);
    put(part, "mean", quantity.mean);
    put(part, "ci95", quantity.ci95);
    putReasonsLast(part);
    return part;
}

void putMilliseconds(Json& row, const char* key, const std::optional<double>& value)
{
    put(row, key, value ? stats::Value(*value) : stats::Value::undefined("no signal was answered"));
}

}  // namespace

Json touchMember(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    Json part = Json::object();
    if (analysis.touch.empty()) {
        putNull(part, "touch", noFingerSamples);
        return part;
    }
    Json conditions = Json::object();
    for (std::size_t c = 0; c < data.conditions.size(); ++c)
        conditions[data.conditions[c]] = {{"speed_mm_per_s", quantityPart(analysis.touch[c].speedMmPerS)},
                                          {"force_n", quantityPart(analysis.touch[c].forceN)},
                                          {"contact_seconds", quantityPart(analysis.touch[c].contactSeconds)}};
    part["touch"] = {{"generalises_to", "these_fabrics"}, {"presentations", data.touches.size()}, {"conditions", conditions}};
    return part;
}

Json operatorLatencyMember(const StudyData& data)
{
    Json part = Json::object();
    if (data.operatorTaps.empty()) {
        putNull(part, "operator_latency", "no operator did the latency task");
        return part;
    }
    Json rows = Json::array();
    for (const OperatorTaps& run : data.operatorTaps) {
        Json row{{"operator", run.operatorName}, {"time", run.wallTime},
                 {"signal", run.signal},         {"taps", run.taps},
                 {"misses", run.misses},         {"anticipations", run.anticipations}};
        putMilliseconds(row, "median_ms", run.medianMs);
        putMilliseconds(row, "q1_ms", run.q1Ms);
        putMilliseconds(row, "q3_ms", run.q3Ms);
        putReasonsLast(row);
        rows.push_back(std::move(row));
    }
    part["operator_latency"] = std::move(rows);
    return part;
}

}  // namespace reports
