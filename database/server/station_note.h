// The note of a station's folder: the computer that opens it, and the study that it belongs to.
#pragma once

#include "database/disk/server_note.h"
#include "database/disk/study_folder.h"
#include "database/session_store.h"

namespace database {

/// Two computers with one token would take each other's place at the server, so a folder that was copied from another computer
/// gets a token of its own. Call it with the folder locked. Throws badInput where there is no note.
ServerNote noteOfStation(const StudyFolder& folder);

/// SHA-256 of what every station learns of a study and no act changes: its name, when and by which program it was made, and its
/// fabrics. It stays the same at another address, and after a move to a folder and back.
std::string identityOf(const StudyFacts& facts);

/// Writes down which study the server has at the note's address. Throws badInput where it is another study than before, unless
/// the folder may follow it: nothing waits, no session is open, and the folder is not that of an owner.
void noteStudy(const StudyFolder& folder, ServerNote& note, const StudyFacts& found, bool mayFollow);

}  // namespace database
