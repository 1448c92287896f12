#include "database/disk/server_note.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/process/computer_name.h"

namespace database {

namespace {

constexpr const char* noteSchema = "vis2hap.on-server/1";
constexpr std::uint64_t largestNote = 1 << 16;

}  // namespace

std::filesystem::path serverNoteOf(const std::filesystem::path& folder) { return folder / "server.json"; }

std::string hashOfThisComputer()
{
    const std::string machine = protocols::readIfPossible("/etc/machine-id").value_or(std::string());
    return protocols::sha256("vis2hap.station " + machine + " " + protocols::computerName());
}

void writeServerNote(const std::filesystem::path& folder, const ServerNote& note)
{
    const nlohmann::ordered_json document{{"schema", noteSchema}, {"address", note.address}, {"station", note.station},
                                          {"token", note.token},  {"owner", note.isOwner},   {"computer", note.computer},
                                          {"study", note.study}};
    protocols::writeWholeFile(serverNoteOf(folder), document.dump(2) + "\n", protocols::Sync::Now, protocols::Readers::OwnerOnly);
}

std::optional<ServerNote> readServerNote(const std::filesystem::path& folder)
{
    std::error_code unreadable;
    if (!std::filesystem::exists(serverNoteOf(folder), unreadable)) return std::nullopt;
    const std::string where = serverNoteOf(folder).string();
    const nlohmann::json document = protocols::parseStrictJson(protocols::readRegularFile(where, largestNote), where);
    try {
        if (document.at("schema") != noteSchema) throw protocols::badInput({});
        return ServerNote{document.at("address").get<std::string>(), document.at("station").get<std::string>(),
                          document.at("token").get<std::string>(),   document.at("owner").get<bool>(),
                          document.value("computer", std::string()), document.value("study", std::string())};
    } catch (const std::exception&) {
        throw protocols::badInput({"this is no note of a study on a server", where,
                                   std::string("an object with the schema ") + noteSchema, "join the study again"});
    }
}

}  // namespace database
