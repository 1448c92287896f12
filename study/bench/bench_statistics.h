// Speed and error of the statistics that must be fast, on one core, beside the times of R and packages of Python for the same
// work on this machine.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace study::bench {

/// One row a stage: {"stage", "quality", "ms", "error", "error_is", "note"}, and with `peers`
/// {"peers": {"scipy": ms | null, ...}}, null where a peer is not installed.
nlohmann::ordered_json statisticsRows(bool peers);

}  // namespace study::bench
