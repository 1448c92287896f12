// How long an operator takes from a tone to a key: entries of the log about the study itself, because they hold no data of a
// participant. The functions open a connection of their own; whoever records keeps the store open for writing, and with it the
// lock.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

/// One run of the latency task.
struct OperatorLatency {
    std::string operatorName;
    std::string signal;                          ///< what the operator waited for: "tone", or "flash" without sound
    double seconds = 0;                          ///< duration of the task
    int taps = 0;                                ///< signals with a tap
    int misses = 0;                              ///< signals without a tap
    int anticipations = 0;                       ///< taps before a signal, or less than 100 ms after it; not among the taps
    std::optional<double> medianMs, q1Ms, q3Ms;  ///< of the taps; none without taps
    std::string wallTime;                        ///< ISO 8601; set by recordOperatorLatency
    std::int64_t entry = 0;                      ///< number in the log; set by recordOperatorLatency
    bool operator==(const OperatorLatency&) const = default;
};

/// Throws badInput for an empty operator.
void requireOperator(const OperatorLatency& run, const std::string& where);
/// What the log keeps of a run.
nlohmann::ordered_json latencyPayload(const OperatorLatency& run);

/// Appends the run to the log; returns after the sync. Throws badInput for an empty operator, environmentFault (disk full,
/// read-only).
void recordOperatorLatency(const StudyStore& store, const OperatorLatency& run);

/// In the order of the log. Entries that somebody altered have default values where a field cannot be read.
std::vector<OperatorLatency> operatorLatenciesOf(const StudyStore& store);

}  // namespace database
