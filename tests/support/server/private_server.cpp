#include "tests/support/server/private_server.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QProcess>
#include <QSqlDatabase>
#include <QTcpServer>
#include <QThread>
#include <stdexcept>

#include "database/server/server_connection.h"

namespace tests::support {

namespace {

const QString programs = QStringLiteral("/usr/lib/postgresql/15/bin/");

/// Runs one of PostgreSQL's programs, which refuse to run as root.
void run(const QString& program, QStringList arguments)
{
    arguments.prepend(programs + program);
    if (::geteuid() == 0)
        arguments = QStringList{"setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups"} + arguments;
    QProcess process;
    process.setStandardInputFile(QProcess::nullDevice());
    process.setStandardOutputFile(QProcess::nullDevice());
    process.setStandardErrorFile(QProcess::nullDevice());
    process.setWorkingDirectory("/");
    process.start(arguments.takeFirst(), arguments);
    if (!process.waitForFinished(120000) || process.exitCode() != 0)
        throw std::runtime_error(program.toStdString() + " failed with " + std::to_string(process.exitCode()));
}

int freePort()
{
    QTcpServer server;
    server.listen(QHostAddress::LocalHost);
    return server.serverPort();
}

}  // namespace

QString PrivateServer::whyMissing()
{
    if (!QFile::exists(programs + "initdb")) return "PostgreSQL 15 is not installed (package postgresql-15)";
    if (!QSqlDatabase::isDriverAvailable("QPSQL")) return "Qt's driver for PostgreSQL is not installed (package libqt6sql6-psql)";
    return {};
}

PrivateServer::PrivateServer() : m_port(freePort())
{
    if (::geteuid() == 0) {
        QProcess::execute("chown", {"postgres", m_folder.path()});
        ::chmod(m_folder.path().toUtf8().constData(), 0755);
    }
    run("initdb", {"-D", data(), "-E", "UTF8", "--locale=C.UTF-8", "-A", "trust", "-U", "owner", "--no-sync"});
    QFile settings(data() + "/postgresql.conf");
    if (!settings.open(QIODevice::Append)) throw std::runtime_error("the server's settings cannot be written");
    // Tests kill processes, never the computer: what the server wrote stays without a sync, and no busy disk holds up a test.
    settings.write(QString("listen_addresses = '127.0.0.1'\nport = %1\nunix_socket_directories = ''\nmax_connections = 200\n"
                           "fsync = off\nfull_page_writes = off\n")
                       .arg(m_port)
                       .toUtf8());
    settings.close();
    start();
    database::ServerConnection(
        database::serverAddressFrom("postgresql://owner@127.0.0.1:" + std::to_string(m_port) + "/postgres"))
        .run("CREATE DATABASE lab");
}

PrivateServer::~PrivateServer()
{
    try {
        stop();
    } catch (const std::runtime_error&) {
        // A test has killed it.
    }
}

std::string PrivateServer::address(const std::string& study, const std::string& user, int port) const
{
    return "postgresql://" + user + "@127.0.0.1:" + std::to_string(port == 0 ? m_port : port) + "/lab?study=" + study;
}

QByteArray PrivateServer::log() const
{
    QFile file(m_folder.filePath("log"));
    if (!file.open(QIODevice::ReadOnly)) throw std::runtime_error("the server's log cannot be read");
    return file.readAll();
}

void PrivateServer::start() { run("pg_ctl", {"-D", data(), "-w", "-t", "60", "-l", m_folder.filePath("log"), "start"}); }

void PrivateServer::stop() { run("pg_ctl", {"-D", data(), "-w", "-m", "immediate", "stop"}); }

void PrivateServer::becomeStandBy()
{
    run("pg_ctl", {"-D", data(), "-w", "-m", "fast", "stop"});
    QFile sign(data() + "/standby.signal");
    if (!sign.open(QIODevice::WriteOnly)) throw std::runtime_error("the server's settings cannot be written");
    sign.close();
    if (::geteuid() == 0) QProcess::execute("chown", {"postgres", sign.fileName()});
    start();
}

void PrivateServer::kill()
{
    QFile file(data() + "/postmaster.pid");
    if (!file.open(QIODevice::ReadOnly)) throw std::runtime_error("the server does not run");
    const int pid = file.readLine().trimmed().toInt();
    QProcess::execute("pkill", {"-KILL", "-P", QString::number(pid)});
    ::kill(pid, SIGKILL);
    while (::kill(pid, 0) == 0) QThread::msleep(5);
    QThread::msleep(200);  // its children end, too, and free its memory
}

}  // namespace tests::support
