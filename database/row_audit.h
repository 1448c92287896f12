// Entries that no session of this program writes, though the chain holds them: a login of a server may send what it likes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "database/event_chain.h"

namespace database {

/// By question: the field of the payload that tells its answer, "fabric", "same", "words" or "tenths".
using TellingFields = std::map<std::string, std::string>;

/// What no session writes of the entry's time, sitting and answers; empty for a sound entry. An answer must be the one that the
/// entry's payload tells, with stamps in their order. Samples of the finger are not looked at. Not for an erased entry. A
/// question that is missing in `fields` may have any field.
std::vector<std::string> faultsOfEntry(const LogEntry& entry, const TellingFields& fields);

/// Why a row of samples of the finger is none that this program writes; empty for a sound one. `samples`: the column's text.
std::string faultOfFinger(const FingerRow& row, const std::string& samples);

}  // namespace database
