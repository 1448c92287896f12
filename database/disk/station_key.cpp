#include "database/disk/station_key.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

constexpr const char* stationKeySchema = "vis2hap.station-key/1";

}  // namespace

std::string writeStationKey(const StudyFolder& folder, const protocols::SecretKey& key)
{
    const std::string text = nlohmann::ordered_json{{"schema", stationKeySchema}, {"key", key.hex()}}.dump(2) + "\n";
    protocols::writeWholeFile(folder.stationKey(), text, protocols::Sync::Later, protocols::Readers::OwnerOnly);
    return protocols::sha256(text);
}

protocols::SecretKey stationKeyFromJson(const std::string& text, const std::string& where)
{
    const nlohmann::json document = protocols::parseStrictJson(text, where);
    if (!document.is_object() || document.value("schema", nlohmann::json()) != stationKeySchema || !document.contains("key") ||
        !document["key"].is_string())
        throw protocols::badInput({"this is no station key", where,
                                   std::string("an object with the schema ") + stationKeySchema + " and a key",
                                   "restore station-key.json from a backup"});
    return protocols::SecretKey::ofHex(document["key"].get<std::string>(), where);
}

protocols::SecretKey readStationKey(const StudyFolder& folder, const std::string& committed)
{
    const std::filesystem::path file = folder.stationKey();
    const auto text = protocols::readIfPossible(file);
    const auto refused = [&](const std::string& what) {
        return protocols::workFailed({what, file.string(), "the file that was made with the study",
                                      "restore it from a backup; the owner's passphrase opens the reports without it"});
    };
    if (!text) throw refused("the station key cannot be read");
    if (protocols::sha256(*text) != committed) throw refused("the station key is not the one committed in the database");
    return stationKeyFromJson(*text, file.string());
}

}  // namespace database
