// The sentences of the rooms below the window, for its catalogues. Each is written as the room writes it; %1 to %5 stand for what
// it fills in. A new sentence that operators see gets a line in the source.
#pragma once

#include <span>

namespace study::app {

std::span<const char* const> tableOfBelow();

/// The context of these sentences in a catalogue.
constexpr const char* contextOfBelow = "study::app::Below";

}  // namespace study::app
