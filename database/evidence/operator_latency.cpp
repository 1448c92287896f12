#include "database/evidence/operator_latency.h"

#include <nlohmann/json.hpp>

#include "database/disk/payload_fields.h"
#include "database/event_chain.h"
#include "database/sqlite_connection.h"
#include "database/stored_texts.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

constexpr const char* latencyKind = "latency_measured";

nlohmann::ordered_json numberOrNull(const std::optional<double>& value)
{
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

std::optional<double> realIn(const nlohmann::json& payload, const char* field)
{
    const auto value = payload.find(field);
    return value != payload.end() && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

}  // namespace

void requireOperator(const OperatorLatency& run, const std::string& where)
{
    if (run.operatorName.empty())
        throw protocols::badInput(
            {"the latency task needs the operator's name", where, "a name", "enter the name, then repeat the task"});
}

nlohmann::ordered_json latencyPayload(const OperatorLatency& run)
{
    return {{"operator", run.operatorName},
            {"signal", run.signal},
            {"seconds", run.seconds},
            {"taps", run.taps},
            {"misses", run.misses},
            {"anticipations", run.anticipations},
            {"median_ms", numberOrNull(run.medianMs)},
            {"q1_ms", numberOrNull(run.q1Ms)},
            {"q3_ms", numberOrNull(run.q3Ms)}};
}

void recordOperatorLatency(const StudyStore& store, const OperatorLatency& run)
{
    requireOperator(run, store.folder().folder.string());
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Write);
    Transaction transaction(sqlite);
    database::store(sqlite, actOnStudy(latencyKind, latencyPayload(run), wallTimeNow()));
    transaction.commit();
}

std::vector<OperatorLatency> operatorLatenciesOf(const StudyStore& store)
{
    std::vector<OperatorLatency> runs;
    for (const EventRecord& event : store.eventsOfKind(latencyKind)) {
        if (!event.participant.empty()) continue;
        const nlohmann::json payload = payloadIn(event.payloadJson);
        runs.push_back({textIn(payload, "operator"), textIn(payload, "signal"), realIn(payload, "seconds").value_or(0),
                        numberIn(payload, "taps", 0), numberIn(payload, "misses", 0), numberIn(payload, "anticipations", 0),
                        realIn(payload, "median_ms"), realIn(payload, "q1_ms"), realIn(payload, "q3_ms"), event.wallTime,
                        event.sequence});
    }
    return runs;
}

}  // namespace database
