// Events as text for the log, and back.
#pragma once

#include <string>

#include "study/session/operated_by.h"
#include "study/session/session.h"

namespace study::session {

/// The event's kind in the log: "answered", "paused", ...
std::string kindOf(const EventBody& body);

/// "entry", "spoken", "script".
std::string nameOf(BegunBy by);

/// What the log keeps of the event, as JSON. Personal values (facts, debriefing) are left out. The start of a sitting names
/// operator, program and host; corrections and voids name the operator; an empty `operatedBy` adds nothing.
std::string payloadJson(const EventBody& body, const OperatedBy& operatedBy = {});

/// The event of a record. Throws workFailed for a record that this version cannot read.
EventBody eventFromRecord(const std::string& kind, const std::string& payloadJson);

}  // namespace study::session
