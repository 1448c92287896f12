#include "tests/support/server/engine_session.h"

#include "database/disk/server_note.h"
#include "database/server/server_connection.h"
#include "database/server/station_store.h"
#include "database/server/study_move.h"
#include "study/session/station_images.h"
#include "study/session/stimuli.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/server/server_session.h"

namespace tests::support {

bool EngineUnderTest::isServer() { return qEnvironmentVariable("VIS2HAP_TEST_ENGINE") == "server"; }

QString EngineUnderTest::whyMissing() { return isServer() ? PrivateServer::whyMissing() : QString(); }

database::StudyFolder EngineUnderTest::study(const std::filesystem::path& folder, const StudyRecipe& recipe)
{
    const database::StudyFolder made = buildStudy(folder, recipe);
    if (!isServer()) return made;
    if (!m_server) m_server = std::make_unique<PrivateServer>();
    moveToServer(made, database::serverAddressFrom(m_server->address("study_" + std::to_string(++m_studies))), "owner");
    return made;
}

void EngineUnderTest::meddle(const database::StudyFolder& folder, const std::string& table, const std::string& sql)
{
    if (const auto note = database::readServerNote(folder.folder)) {
        const database::ServerConnection server(database::serverAddressFrom(note->address));
        const QString changed = QString::fromStdString("@schema@." + table);
        server.run("ALTER TABLE " + changed + " DISABLE TRIGGER USER");
        server.run("UPDATE " + changed + " " + QString::fromStdString(sql));
        return;
    }
    RawSqlite raw(folder.database());
    raw.dropTriggers();
    if (const std::string fault = raw.run("UPDATE " + table + " " + sql); !fault.empty()) throw std::runtime_error(fault);
}

std::vector<std::string> rowsFound(const database::StudyFolder& folder, const std::string& query)
{
    const database::StudyStore study = readStudy(folder);
    return RawSqlite(study.folder().database()).rows(query);
}

EngineSession::EngineSession(const database::StudyFolder& folder, const std::string& participant, database::ParticipantKind kind,
                             const study::session::OperatedBy& operatedBy)
{
    if (database::readServerNote(folder.folder)) {
        auto station = std::make_unique<database::StationStore>(folder, unhurried);
        images = std::make_unique<study::session::StationImages>(*station);
        store = std::move(station);
    } else {
        auto file = std::make_unique<database::StudyStore>(folder, database::StudyStore::Access::Write);
        images = std::make_unique<rendering::StimulusBank>(study::session::stimuliOf(*file));
        store = std::move(file);
    }
    driver = std::make_unique<study::session::Driver>(*store, protocols::ParticipantId(participant), kind, *images, display,
                                                      clock, operatedBy);
}

const database::StudyStore& EngineSession::rows()
{
    if (const auto* file = dynamic_cast<const database::StudyStore*>(store.get())) return *file;
    return m_rows.emplace(readStudy(store->folder()));
}

}  // namespace tests::support
