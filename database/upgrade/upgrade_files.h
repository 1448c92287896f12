// The files of a study while it is upgraded. The steps themselves are declared in database/disk/study_upgrade.h, because the
// store, from which an upgrade reads, calls them.
#pragma once

#include <filesystem>

#include "database/disk/study_upgrade.h"

namespace database {

/// Mode 0600, or 0700 for a folder. Some sticks and network shares refuse it; `verify` then names who can read the study.
void keepToOwner(const std::filesystem::path& place);

}  // namespace database
