// What an upgrade makes of an older study: new keys, sealed stimuli, and a database of the present schema.
#pragma once

#include "database/disk/study_folder.h"

namespace database {

/// Fills .upgrade/ with all that is new. Throws as upgrade().
void prepareAnew(const StudyFolder& folder);

}  // namespace database
