// The speed of the statistics that have to be fast, on one core, with their error; beside what R and
// Python's packages take for the same work on this machine, where they are installed.
#pragma once

#include <nlohmann/json.hpp>

namespace study::bench {

/// One row a stage: {"stage", "quality", "ms", "error", "error_is", "note"}, and with `peers`
/// {"peers": {"scipy": ms | null, ...}}, null where a peer is not installed.
nlohmann::ordered_json statisticsRows(bool peers);

}  // namespace study::bench
