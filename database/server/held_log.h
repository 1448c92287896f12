// The log of one participant as a station holds it, compared with the log that the server gives at a new claim. Entries that the
// server has not confirmed have the sequence 0.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "database/session_store.h"

namespace database {

/// How the server's log differs, such as "lost entries of P01 (2)"; none where every confirmed entry stands at its place and only
/// held entries follow.
std::optional<std::string> differenceOf(const std::string& participant, const std::vector<EventRecord>& held,
                                        const std::vector<EventRecord>& onServer);

/// The first held entry without a number gets this one, unless an entry has it already.
void confirmFirst(std::vector<EventRecord>& held, std::int64_t sequence);

/// Writes the held entries into a new file of the folder, one a line, and returns the file.
std::filesystem::path keepHeldLog(const StudyFolder& folder, const std::string& participant,
                                  const std::vector<EventRecord>& held);

}  // namespace database
