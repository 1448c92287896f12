#include "database/server/station_note.h"

#include "protocols/files/errors.h"
#include "protocols/secrets/secret_key.h"

namespace database {

ServerNote noteOfStation(const StudyFolder& folder)
{
    if (auto note = readServerNote(folder.folder)) {
        const std::string here = hashOfThisComputer();
        if (note->computer == here) return *note;
        if (!note->computer.empty()) note->token = protocols::drawHex(32);
        note->computer = here;
        writeServerNote(folder.folder, *note);
        return *note;
    }
    throw protocols::badInput({"this folder belongs to no study on a server", folder.folder.string(), "a folder with server.json",
                               "join the study with vis2hap study join ADDRESS"});
}

}  // namespace database
