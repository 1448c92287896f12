#include "database/server/station_note.h"

#include "protocols/files/canonical_bytes.h"
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

std::string identityOf(const StudyFacts& facts)
{
    protocols::CanonicalBytes bytes;
    bytes << facts.name << facts.createdAt << facts.programVersion;
    for (const protocols::FabricId& fabric : facts.fabrics) bytes << fabric.value << facts.fabricNames.at(fabric);
    return bytes.hash();
}

void noteStudy(const StudyFolder& folder, ServerNote& note, const StudyFacts& found, bool mayFollow)
{
    const std::string identity = identityOf(found);
    if (note.study == identity) return;
    if (!note.study.empty() && (note.isOwner || !mayFollow))
        throw protocols::badInput({"the server has another study of this name than before", note.address,
                                   "the study of " + folder.folder.string(),
                                   "ask the study's owner; move this folder elsewhere to join the other study"});
    note.study = identity;
    writeServerNote(folder.folder, note);
}

}  // namespace database
