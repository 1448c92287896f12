// The note of a station's folder, on the computer that opens it.
#pragma once

#include "database/disk/server_note.h"
#include "database/disk/study_folder.h"

namespace database {

/// Two computers with one token would take each other's place at the server, so a folder that was copied from another computer
/// gets a token of its own. Call it with the folder locked. Throws badInput where there is no note.
ServerNote noteOfStation(const StudyFolder& folder);

}  // namespace database
