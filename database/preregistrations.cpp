#include "database/preregistrations.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "database/event_chain.h"
#include "database/sqlite_connection.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"

namespace database {

namespace {

/// Also answers that were erased since: earlier versions of this program did not count those that were erased before the plan.
std::size_t answersGivenBefore(const SqliteConnection& sqlite, qlonglong event)
{
    return sqlite.value(QStringLiteral("SELECT COUNT(*) FROM events WHERE kind = 'answered' AND sequence < ?"), {event})
        .toULongLong();
}

std::vector<PreregistrationRecord> preregistrationsIn(const SqliteConnection& sqlite)
{
    std::vector<PreregistrationRecord> records;
    QSqlQuery row = sqlite.run(QStringLiteral(
        "SELECT payload, wall_time, sequence FROM events WHERE kind = 'preregistered' AND participant = '' ORDER BY sequence"));
    while (row.next()) {
        const auto payload = protocols::storedJson(fromQt(row.value(0)));
        if (!isPreregistration(payload))
            throw protocols::workFailed({"a preregistration in the log cannot be read", sqlite.file().string(), "",
                                         "see `vis2hap verify`; restore the study from a backup"});
        const qlonglong event = row.value(2).toLongLong();
        const auto answersBefore = std::max(payload["answers_before"].get<std::size_t>(), answersGivenBefore(sqlite, event));
        records.push_back({payload["number"], answersBefore, payload["after_unblinding"], payload["who"], payload["text"],
                           payload["json"], fromQt(row.value(1)), event});
    }
    return records;
}

}  // namespace

std::string PreregistrationRecord::textSha256() const { return protocols::sha256(text); }

std::string PreregistrationRecord::jsonSha256() const { return protocols::sha256(json); }

void recordPreregistration(const StudyStore& store, const PreregistrationRecord& record)
{
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Write);
    Transaction transaction(sqlite);
    const int next = static_cast<int>(preregistrationsIn(sqlite).size()) + 1;
    if (record.number != next)
        throw protocols::workFailed({"the next registered plan has number " + std::to_string(next),
                                     store.folder().folder.string(), "not " + std::to_string(record.number), "try again"});
    database::store(sqlite, actOnStudy("preregistered", payloadOf(record), record.wallTime));
    transaction.commit();
}

std::vector<PreregistrationRecord> preregistrationsOf(const StudyStore& store)
{
    return preregistrationsIn({store.folder().database(), SqliteConnection::Mode::Read});
}

nlohmann::ordered_json payloadOf(const PreregistrationRecord& record)
{
    return {{"number", record.number},
            {"answers_before", record.answersBefore},
            {"after_unblinding", record.afterUnblinding},
            {"who", record.who},
            {"text_sha256", record.textSha256()},
            {"json_sha256", record.jsonSha256()},
            {"text", record.text},
            {"json", record.json}};
}

bool isPreregistration(const nlohmann::json& payload)
{
    if (!payload.is_object()) return false;
    for (const char* text : {"who", "text_sha256", "json_sha256", "text", "json"})
        if (!payload.contains(text) || !payload[text].is_string()) return false;
    for (const char* count : {"number", "answers_before"})
        if (!payload.contains(count) || !payload[count].is_number_unsigned() ||
            !std::in_range<int>(payload[count].get<std::uint64_t>()))
            return false;
    return payload.contains("after_unblinding") && payload["after_unblinding"].is_boolean();
}

std::string faultOfPreregistration(const nlohmann::json& payload, int number)
{
    if (!isPreregistration(payload)) return "the registered plan cannot be read";
    if (payload["number"] != number) return "the registered plan is not number " + std::to_string(number);
    for (const char* text : {"text", "json"})
        if (protocols::sha256(payload[text].get<std::string>()) != payload[std::string(text) + "_sha256"].get<std::string>())
            return "the registered plan does not have its own hash";
    return {};
}

std::filesystem::path preregistrationFile(const StudyFolder& folder, int number, const std::string& kind)
{
    return folder.folder / ("preregistration" + (number == 1 ? "" : "-" + std::to_string(number)) + "." + kind);
}

}  // namespace database
