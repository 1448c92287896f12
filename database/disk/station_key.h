// The station key: all that a session needs to show the image of a presentation. It leads from a presentation to its image, but
// not to a fabric or a condition. It lies in station-key.json (mode 0600).
#pragma once

#include <string>

#include "database/disk/study_folder.h"
#include "protocols/secrets/secret_key.h"

namespace database {

/// Writes the file of a new study, which is synced as a whole, and returns its SHA-256.
std::string writeStationKey(const StudyFolder& folder, const protocols::SecretKey& key);

/// The key in the text of the file, which `where` names in errors. Throws badInput.
protocols::SecretKey stationKeyFromJson(const std::string& text, const std::string& where);

/// Throws workFailed where the file is missing or is not the one committed in the database, `committed` (its SHA-256).
protocols::SecretKey readStationKey(const StudyFolder& folder, const std::string& committed);

}  // namespace database
