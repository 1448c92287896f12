// Values that the database keeps as text: lists, names of enumerations, the wall clock.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

/// ["F03","F01","F05"] and back. Reading throws workFailed where the stored text is not such a list.
std::string jsonOf(const std::vector<std::string>& texts);
std::vector<std::string> textsOf(const std::string& json);
std::string jsonOf(const std::vector<protocols::FabricId>& fabrics);
std::vector<protocols::FabricId> fabricsOf(const std::string& json);

/// The value with this name. Throws workFailed where none has it.
ParticipantKind kindNamed(const std::string& name);
SlotState stateNamed(const std::string& name);

/// The system's wall clock, ISO 8601 with milliseconds and zone, for acts outside a session.
std::string wallTimeNow();

}  // namespace database
