// A PostgreSQL server for tests alone: in a temporary folder, on a free port of this computer, run by an unprivileged user.
#pragma once

#include <QString>
#include <QTemporaryDir>
#include <string>

namespace tests::support {

class PrivateServer {
public:
    /// Why no server can be started here, for QSKIP; empty where one can.
    static QString whyMissing();

    /// Starts a server with the owner "owner" and the database "lab". Throws std::runtime_error.
    PrivateServer();
    ~PrivateServer();
    PrivateServer(const PrivateServer&) = delete;
    PrivateServer& operator=(const PrivateServer&) = delete;

    int port() const { return m_port; }
    /// postgresql://USER@127.0.0.1:PORT/lab?study=STUDY. `port`: another way to the server, such as a CutNetwork.
    std::string address(const std::string& study, const std::string& user = "owner", int port = 0) const;

    /// What the server has written into its log.
    QByteArray log() const;

    /// Kills all processes of the server at once.
    void kill();
    void start();
    void stop();
    /// Starts it again as one that takes no entries and waits for those of another server.
    void becomeStandBy();

private:
    QTemporaryDir m_folder;
    int m_port = 0;
    QString data() const { return m_folder.filePath("data"); }
};

}  // namespace tests::support
