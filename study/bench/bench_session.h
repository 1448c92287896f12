// The session's own speed: how long an operator waits, in the engine and in the window.
#pragma once

#include <nlohmann/json.hpp>

namespace study::bench {

/// Rows for `vis2hap bench session`: an answer stored by the engine, a key press until the next question is
/// drawn, a whole session through the window, and the memory that 10,000 trials take. Needs a QApplication;
/// plays scripted participants in a temporary study that vanishes.
nlohmann::ordered_json sessionRows();

}  // namespace study::bench
