// One connection to a study on a PostgreSQL server, through Qt SQL and its driver QPSQL (package libqt6sql6-psql), which is
// loaded when it is first used. A connection belongs to the thread that made it.
#pragma once

#include <QSqlDatabase>
#include <QSqlQuery>
#include <QVariant>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "database/server/server_address.h"
#include "protocols/files/errors.h"

namespace database {

/// The server cannot be reached, or the connection ended. What was sent may have arrived.
class ServerAway : public protocols::Error {
public:
    explicit ServerAway(const protocols::Fault& fault) : Error(protocols::ExitCode::Environment, fault) {}
};

/// Another connection held a lock for longer than lock_timeout.
class ServerLocked : public protocols::Error {
public:
    explicit ServerLocked(const protocols::Fault& fault) : Error(protocols::ExitCode::WorkFailed, fault) {}
};

/// A study on the server refused a step, by one of its own rules (functions.sql).
class ServerRefusal : public protocols::Error {
public:
    ServerRefusal(protocols::ExitCode code, const protocols::Fault& fault, std::string rule)
        : Error(code, fault), m_rule(std::move(rule))
    {
    }
    /// Such as "VH204".
    const std::string& rule() const { return m_rule; }

private:
    std::string m_rule;
};

class ServerConnection {
public:
    /// Throws environmentFault without the driver, for a server of another major version or behind a pooler, ServerAway where
    /// nobody answers, badInput for a wrong password or an unknown database.
    explicit ServerConnection(ServerAddress address);
    ~ServerConnection();
    ServerConnection(const ServerConnection&) = delete;
    ServerConnection& operator=(const ServerConnection&) = delete;

    const ServerAddress& address() const { return m_address; }
    /// False once a lost connection was noticed.
    bool isOpen() const { return m_connection.isOpen(); }
    /// The studies of the database by name, those that this login may see.
    QStringList studies() const;
    /// Finds the only study where the address names none. Throws badInput where there is none, or where there are several.
    void chooseStudy();

    /// `"vis2hap_NAME"`, ready to stand in a statement.
    QString schema() const;

    /// Executes the statement with its values bound to "?" in order. @schema@ stands for the study's schema.
    QSqlQuery run(const QString& sql, const QVariantList& values = {}) const;
    QVariant value(const QString& sql, const QVariantList& values = {}) const;
    /// The JSON that one of the study's functions returns. A refusal that it returns as a value is thrown as one.
    nlohmann::json call(const char* function, const QVariantList& arguments) const;
    /// After the last row: throws what ended the reading, where it was not the end of the rows.
    void requireRead(const QSqlQuery& rows) const;
    /// Executes a file of several statements without values.
    void runScript(const QString& sql) const;

private:
    QString completed(const QString& sql) const;
    void open();
    void requireNoPooler() const;
    [[noreturn]] void fail(const QSqlError& error) const;
    /// `parts`: what, expected and next step.
    [[noreturn]] void fail(const QString& code, const QStringList& parts) const;

    ServerAddress m_address;
    QString m_name;
    QSqlDatabase m_connection;
};

/// BEGIN; rolls back unless commit() was called.
class ServerTransaction {
public:
    enum class Kind { Write, ReadOneState };
    explicit ServerTransaction(const ServerConnection& connection, Kind kind = Kind::Write);
    ~ServerTransaction();
    ServerTransaction(const ServerTransaction&) = delete;
    ServerTransaction& operator=(const ServerTransaction&) = delete;
    void commit();

private:
    const ServerConnection& m_connection;
    bool m_committed = false;
};

}  // namespace database
