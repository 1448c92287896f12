#include "database/server/server_rights.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "database/server/server_connection.h"
#include "database/sqlite_connection.h"
#include "database/study_store.h"
#include "protocols/secrets/secret_key.h"

namespace database {

namespace {

/// Groups and rights of PostgreSQL itself that reach around the rights of a study.
constexpr const char* mightyRoles[] = {"pg_read_all_data",      "pg_write_all_data",         "pg_read_server_files",
                                       "pg_write_server_files", "pg_execute_server_program", "pg_read_all_settings",
                                       "pg_stat_scan_tables",   "pg_read_all_stats",         "pg_signal_backend"};

std::vector<std::string> textsIn(const ServerConnection& server, const QString& sql, const QVariantList& values = {})
{
    std::vector<std::string> texts;
    QSqlQuery row = server.run(sql, values);
    while (row.next()) texts.push_back(fromQt(row.value(0)));
    server.requireRead(row);
    return texts;
}

bool yes(const ServerConnection& server, const QString& sql, const QVariantList& values = {})
{
    return server.value(sql, values).toBool();
}

QString schemaName(const ServerConnection& server) { return QStringLiteral("vis2hap_%1").arg(toQt(server.address().study)); }

void addRoles(const ServerConnection& server, ServerRights& rights)
{
    for (const char* role : {"experimenter", "monitor", "analyst", "display"})
        if (yes(server,
                QStringLiteral("SELECT COALESCE((SELECT pg_has_role(oid, 'MEMBER') FROM pg_roles WHERE rolname = ?), false)"),
                {QStringLiteral("%1_%2").arg(schemaName(server), QLatin1String(role))}))
            rights.roles.emplace_back(role);
    if (yes(server, QStringLiteral("SELECT pg_has_role(nspowner, 'MEMBER') FROM pg_namespace WHERE nspname = ?"),
            {schemaName(server)}))
        rights.roles.emplace_back("owner");
}

void addRightsOnTables(const ServerConnection& server, ServerRights& rights)
{
    for (const char* right : {"SELECT", "INSERT", "UPDATE", "DELETE", "TRUNCATE", "TRIGGER"}) {
        const bool isOfColumns =
            std::string(right) == "SELECT" || std::string(right) == "INSERT" || std::string(right) == "UPDATE";
        const auto tables = textsIn(
            server,
            QStringLiteral("SELECT c.relname FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace WHERE n.nspname = ? "
                           "AND c.relkind IN ('r', 'v', 'm', 'S') AND (has_table_privilege(c.oid, ?)%1) ORDER BY c.relname")
                .arg(isOfColumns ? QStringLiteral(" OR has_any_column_privilege(c.oid, '%1')").arg(QLatin1String(right))
                                 : QString()),
            {schemaName(server), QString(QLatin1String(right))});
        for (const std::string& table : tables) rights.learns.push_back(std::string(right) + " on the table " + table);
    }
    if (yes(server, QStringLiteral("SELECT has_schema_privilege(?, 'CREATE')"), {schemaName(server)}))
        rights.learns.emplace_back("CREATE in the schema of the study");
}

void addFunctions(const ServerConnection& server, ServerRights& rights)
{
    const auto functions =
        textsIn(server,
                QStringLiteral(
                    "SELECT DISTINCT p.proname FROM pg_proc p JOIN pg_namespace n ON n.oid = p.pronamespace WHERE n.nspname = ? "
                    "AND has_function_privilege(p.oid, 'EXECUTE') ORDER BY p.proname"),
                {schemaName(server)});
    for (const std::string& function : functions)
        if (function.starts_with("server_"))
            rights.learns.push_back("the inner function " + function);
        else
            rights.may.push_back(function);
}

void addMight(const ServerConnection& server, ServerRights& rights)
{
    for (const auto& [column, meaning] :
         {std::pair("rolsuper", "everything: the login is a superuser"), std::pair("rolbypassrls", "rows in spite of rules"),
          std::pair("rolreplication", "the whole database by replication"),
          std::pair("rolcreaterole", "other roles: the login makes roles")})
        if (yes(server, QStringLiteral("SELECT %1 FROM pg_roles WHERE rolname = session_user").arg(QLatin1String(column))))
            rights.learns.emplace_back(meaning);
    for (const char* role : mightyRoles)
        if (yes(server, QStringLiteral("SELECT pg_has_role(?, 'MEMBER')"), {QString(QLatin1String(role))}))
            rights.learns.push_back(std::string("the role ") + role);
}

/// Where stations get tickets, a login that may also fetch images undoes it.
void addImages(const ServerConnection& server, ServerRights& rights)
{
    for (const char* function : {"overview", "progress"})
        if (rights.imagesTo.empty() && std::ranges::find(rights.may, function) != rights.may.end())
            rights.imagesTo = server.call(function, {}).at("images_to").get<std::string>();
    const auto has = [&](const char* role) { return std::ranges::find(rights.roles, role) != rights.roles.end(); };
    const auto counters = readCounters();
    const auto mayRead = [&](const std::string& counter) {
        return yes(server, QStringLiteral("SELECT has_function_privilege(?, 'EXECUTE')"), {toQt(counter)});
    };
    if (rights.imagesTo == "display" && has("experimenter") && std::ranges::any_of(counters, mayRead))
        rights.learns.emplace_back(
            "which presentations have the same image: it may read how many blocks of the images were read "
            "(pg_statio_all_tables)");
    if (has("experimenter") && has("display"))
        rights.learns.emplace_back("the image of each of its tickets: the login has the role display, too");
}

/// Tries what a curious operator would.
void addTries(const ServerConnection& server, ServerRights& rights)
{
    const auto tried = [&](const std::string& what, const QString& sql) {
        try {
            QSqlQuery row = server.run(sql);
            if (row.next()) rights.learns.push_back(what);
        } catch (const protocols::Error&) {
            rights.refused.push_back(what);
        }
    };
    tried("the answers", QStringLiteral("SELECT * FROM @schema@.responses"));
    tried("the trays ahead", QStringLiteral("SELECT alternatives FROM @schema@.trials"));
    tried("which image a presentation shows", QStringLiteral("SELECT * FROM @schema@.server_trials"));
    tried("the keys of the images", QStringLiteral("SELECT key FROM @schema@.server_images"));
    tried("a presentation without a participant", QStringLiteral("SELECT * FROM @schema@.presentation(1)"));
    tried("an image without a ticket", QStringLiteral("SELECT * FROM @schema@.released_image('1')"));
    tried("a file of the server", QStringLiteral("SELECT pg_read_file('postgresql.conf')"));
    tried("the owner's rights",
          QStringLiteral("SELECT set_config('role', pg_get_userbyid(nspowner), false) FROM pg_namespace WHERE nspname = '%1'")
              .arg(schemaName(server)));
}

}  // namespace

std::vector<std::string> readCounters()
{
    return {"pg_stat_get_blocks_fetched(oid)", "pg_stat_get_blocks_hit(oid)", "pg_stat_get_db_blocks_fetched(oid)",
            "pg_stat_get_db_blocks_hit(oid)"};
}

ServerRights rightsOf(const ServerAddress& address)
{
    ServerConnection server(address);
    server.chooseStudy();
    ServerRights rights;
    rights.study = server.address().study;
    rights.login = fromQt(server.value(QStringLiteral("SELECT session_user")));
    addRoles(server, rights);
    addRightsOnTables(server, rights);
    addFunctions(server, rights);
    addMight(server, rights);
    addImages(server, rights);
    addTries(server, rights);
    return rights;
}

}  // namespace database
