// Studies and sessions for tests that hold on both engines: study.db in the study's folder, or a PostgreSQL server of the test's
// own where VIS2HAP_TEST_ENGINE is "server".
#pragma once

#include <memory>
#include <optional>

#include "tests/support/played_session.h"
#include "tests/support/server/private_server.h"
#include "tests/support/study_builder.h"

namespace tests::support {

class EngineUnderTest {
public:
    static bool isServer();
    /// Why the engine cannot be tested here, for QSKIP; empty where it can.
    static QString whyMissing();

    /// A new study, as buildStudy() makes it. On a server, `folder` becomes its owner's folder.
    database::StudyFolder study(const std::filesystem::path& folder, const StudyRecipe& recipe = {});
    /// Changes rows of the study past its triggers, as somebody with all rights would. `table` is one of the study's;
    /// `sql` follows "UPDATE table ".
    void meddle(const database::StudyFolder& folder, const std::string& table, const std::string& sql);

private:
    std::unique_ptr<PrivateServer> m_server;
    int m_studies = 0;
};

/// What a query finds in study.db, or in the file that the server's rows make.
std::vector<std::string> rowsFound(const database::StudyFolder& folder, const std::string& query);

/// A session of a study on either engine; the folder tells which.
struct EngineSession : SessionHands {
    EngineSession(const database::StudyFolder& folder, const std::string& participant,
                  database::ParticipantKind kind = database::ParticipantKind::Scripted,
                  const study::session::OperatedBy& operatedBy = {});
    ~EngineSession() { driver.reset(); }

    /// The study's rows as they stand now. The reference is valid until the next call.
    const database::StudyStore& rows();

    std::unique_ptr<database::SessionStore> store;
    std::unique_ptr<rendering::PresentedImages> images;

private:
    std::optional<database::StudyStore> m_rows;  ///< of a study on a server
};

}  // namespace tests::support
