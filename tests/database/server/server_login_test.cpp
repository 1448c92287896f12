// The way to a server: no password in a message, no weaker encryption than somebody asked for, and for each refusal what helps.
#include <QTemporaryDir>
#include <QTest>

#include "database/server/client_library.h"
#include "database/server/login_faults.h"
#include "database/server/login_settings.h"
#include "database/server/server_connection.h"
#include "tests/support/error_text.h"
#include "tests/support/server/cut_network.h"
#include "tests/support/server/private_server.h"

using namespace tests::support;
using database::serverAddressFrom;

namespace {

std::string modeOf(const database::LoginSettings& settings)
{
    std::string mode;
    for (const auto& [name, value] : settings)
        if (name == "sslmode") mode = value;
    return mode;
}

std::string valueOf(const database::LoginSettings& settings, const std::string& wanted)
{
    std::string found;
    for (const auto& [name, value] : settings)
        if (name == wanted) found = value;
    return found;
}

}  // namespace

class ServerLoginTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void noMessageShowsAPassword_data();
    void noMessageShowsAPassword();
    void addressesWithoutAPasswordAreRead_data();
    void addressesWithoutAPasswordAreRead();
    void aSemicolonIsRefused();
    void encryptionIsNeverWeakened_data();
    void encryptionIsNeverWeakened();
    void theServiceFileCounts();
    void aListReachesItsSecondHost();
    void aListAsksForTheServerThatTakesEntries();
    void aPoolerIsRefused();
    void eachRefusalSaysWhatHelps_data();
    void eachRefusalSaysWhatHelps();
    void theServerGivesItsCode();

private:
    QTemporaryDir m_folder;
};

void ServerLoginTest::noMessageShowsAPassword_data()
{
    QTest::addColumn<QString>("password");
    for (const char* password :
         {"Sekret1", "Sek@ret1", "Sek/ret1", "Sek#ret1", "Sek?ret1", "Sek%ret1", "Sek\"ret1", "Sek[ret1", "Sek ret1",
          "1234/Sekret", "1234?Sekret", "1234?Sekret=1", "1234#Sekret", "Sek:ret1", "Sek]ret1"})
        QTest::newRow(password) << password;
}

void ServerLoginTest::noMessageShowsAPassword()
{
    QFETCH(QString, password);
    for (const char* rest : {"@server.lab:5599/lab?study=pilot", "@server.lab/lab?study=pilot", "@server.lab/lab"}) {
        const std::string address = "postgresql://monitor:" + password.toStdString() + rest;
        const QString refusal = errorOf([&] { (void)serverAddressFrom(address); });
        QVERIFY2(refusal.startsWith("2: ") && refusal.contains("password") && refusal.contains("~/.pgpass"), qPrintable(refusal));
        QVERIFY2(!refusal.contains("ret") && !refusal.contains("Sek"), qPrintable(refusal));
        QVERIFY2(refusal.contains("monitor@server.lab"), qPrintable(refusal));
    }
}

void ServerLoginTest::addressesWithoutAPasswordAreRead_data()
{
    QTest::addColumn<QString>("address");
    for (const char* address :
         {"postgresql://anna@server.lab:5599/lab?study=pilot", "postgresql://server.lab:5599/lab?study=pilot&user=a@b",
          "postgresql:///lab?host=/run/postgresql", "postgresql://odd%40us%3Aer@server.lab/lab",
          "postgresql://anna@[::1]:5599/lab", "postgresql://anna@/lab?port=5599,5600"})
        QTest::newRow(address) << address;
}

void ServerLoginTest::addressesWithoutAPasswordAreRead()
{
    QFETCH(QString, address);
    QCOMPARE(errorOf([&] { (void)serverAddressFrom(address.toStdString()); }), QString());
}

void ServerLoginTest::aSemicolonIsRefused()
{
    const QString refusal = errorOf([] { (void)serverAddressFrom("postgresql://a@server.lab/lab?sslrootcert=/a%3Bb.crt"); });
    QVERIFY2(refusal.contains("sslrootcert holds a semicolon"), qPrintable(refusal));
}

void ServerLoginTest::encryptionIsNeverWeakened_data()
{
    QTest::addColumn<QString>("address");
    QTest::addColumn<QString>("host");    // by environment or service
    QTest::addColumn<QString>("number");  // hostaddr
    QTest::addColumn<QString>("mode");
    QTest::addColumn<QString>("expected");  // the setting that is added or kept in the address
    const auto row = [](const char* name, const char* address, const char* host, const char* number, const char* mode,
                        const char* expected) { QTest::newRow(name) << address << host << number << mode << expected; };
    row("host in the address", "postgresql://a@server.lab/lab", "", "", "prefer", "require");
    row("host from a service", "postgresql://a@/lab", "server.lab", "", "prefer", "require");
    row("number from a service", "postgresql://a@localhost/lab", "", "192.0.2.2", "prefer", "require");
    row("mode from a service", "postgresql://a@server.lab/lab", "", "", "verify-full", "");
    row("no encryption by a service", "postgresql://a@server.lab/lab", "", "", "disable", "");
    row("mode in the address", "postgresql://a@server.lab/lab?sslmode=prefer", "", "", "verify-full", "prefer");
    row("a local name before another host", "postgresql://a@/lab?host=localhost,server.lab", "", "", "prefer", "require");
    row("this computer", "postgresql://a@localhost/lab", "server.lab", "", "prefer", "");
    row("a socket", "postgresql://a@/lab?host=/run/postgresql", "server.lab", "", "prefer", "");
    row("the usual socket", "postgresql://a@/lab", "", "", "prefer", "");
    row("two of this computer", "postgresql://a@/lab?host=127.0.0.1,::1", "", "", "prefer", "");
}

void ServerLoginTest::encryptionIsNeverWeakened()
{
    QFETCH(QString, address);
    QFETCH(QString, host);
    QFETCH(QString, number);
    QFETCH(QString, mode);
    QFETCH(QString, expected);
    std::map<std::string, std::string> defaults{{"sslmode", mode.toStdString()}};
    if (!host.isEmpty()) defaults["host"] = host.toStdString();
    if (!number.isEmpty()) defaults["hostaddr"] = number.toStdString();
    const auto settings = loginSettings(serverAddressFrom(address.toStdString()), defaults);
    QCOMPARE(modeOf(settings), expected.toStdString());
    // Where the client library cannot say what it takes from its surroundings, an address without a host may lead anywhere.
    QCOMPARE(modeOf(loginSettings(serverAddressFrom("postgresql://a@/lab"), std::nullopt)), std::string("require"));
}

void ServerLoginTest::theServiceFileCounts()
{
    if (!database::clientDefaults()) QSKIP("PostgreSQL's client library is not installed (package libqt6sql6-psql)");
    QFile file(m_folder.filePath("services"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[plain]\nhost=192.0.2.7\n[full]\nhost=192.0.2.7\nsslmode=verify-full\n");
    file.close();
    qputenv("PGSERVICEFILE", file.fileName().toLocal8Bit());
    const auto address = serverAddressFrom("postgresql://a@/lab?study=x");
    QCOMPARE(modeOf(loginSettings(address, database::clientDefaults())), std::string());
    qputenv("PGSERVICE", "plain");
    QCOMPARE(modeOf(loginSettings(address, database::clientDefaults())), std::string("require"));
    qputenv("PGSERVICE", "full");
    const auto defaults = database::clientDefaults();
    QCOMPARE(defaults->at("sslmode"), std::string("verify-full"));
    QCOMPARE(modeOf(loginSettings(address, defaults)), std::string());
    qunsetenv("PGSERVICE");
    qunsetenv("PGSERVICEFILE");
}

void ServerLoginTest::aListReachesItsSecondHost()
{
    const auto one = loginSettings(serverAddressFrom("postgresql://a@server.lab/lab"), std::nullopt);
    const auto two = loginSettings(serverAddressFrom("postgresql://a@/lab?host=one.lab,two.lab&port=5599,5600"), std::nullopt);
    QCOMPARE(valueOf(one, "connect_timeout"), std::string("4"));
    QCOMPARE(valueOf(two, "connect_timeout"), std::string("2"));
    QCOMPARE(valueOf(two, "port"), std::string("5599,5600"));
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    const PrivateServer server;
    const std::string ports = std::to_string(1) + "," + std::to_string(server.port());
    const database::ServerConnection connection(
        serverAddressFrom("postgresql://owner@/lab?host=127.0.0.1,127.0.0.1&port=" + ports));
    QCOMPARE(connection.value("SELECT 1").toInt(), 1);
}

void ServerLoginTest::aListAsksForTheServerThatTakesEntries()
{
    const auto targetOf = [](const char* address, const std::map<std::string, std::string>& defaults) {
        return valueOf(loginSettings(serverAddressFrom(address), defaults), "target_session_attrs");
    };
    const std::map<std::string, std::string> compiled{{"target_session_attrs", "any"}};
    const char* list = "postgresql://a@/lab?host=one.lab,two.lab";
    QCOMPARE(targetOf(list, compiled), std::string("primary"));
    QCOMPARE(targetOf("postgresql://a@one.lab/lab", compiled), std::string());
    QCOMPARE(targetOf("postgresql://a@/lab?host=one.lab,two.lab&target_session_attrs=any", compiled), std::string("any"));
    QCOMPARE(targetOf(list, {{"target_session_attrs", "prefer-standby"}}), std::string());
    qputenv("PGTARGETSESSIONATTRS", "any");
    QCOMPARE(targetOf(list, compiled), std::string());
    qunsetenv("PGTARGETSESSIONATTRS");
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    PrivateServer standBy;
    const PrivateServer server;
    standBy.becomeStandBy();
    const auto listOf = [&](int second, const char* more) {
        return serverAddressFrom("postgresql://owner@/lab?host=127.0.0.1,127.0.0.1&port=" + std::to_string(standBy.port()) + "," +
                                 std::to_string(second) + more);
    };
    const QString asked = "SELECT pg_is_in_recovery()";
    QCOMPARE(database::ServerConnection(listOf(server.port(), "")).value(asked).toBool(), false);
    const QString none = errorOf([&] { database::ServerConnection{listOf(1, "")}; });
    QVERIFY2(none.contains("no server of the list takes entries") && none.contains("PGTARGETSESSIONATTRS"), qPrintable(none));
    QCOMPARE(database::ServerConnection(listOf(1, "&target_session_attrs=any")).value(asked).toBool(), true);
    QCOMPARE(database::ServerConnection(serverAddressFrom(standBy.address("x"))).value(asked).toBool(), true);
}

/// A pooler tells its clients other process numbers than those of the server's processes that work for them.
void ServerLoginTest::aPoolerIsRefused()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    const PrivateServer server;
    CutNetwork network(server.port());
    const auto address = serverAddressFrom(server.address("x", "owner", network.port()));
    QCOMPARE(errorOf([&] { database::ServerConnection{address}; }), QString());
    network.pool();
    const QString refusal = errorOf([&] { database::ServerConnection{address}; });
    QVERIFY2(refusal.startsWith("3: ") && refusal.contains("a connection pooler stands before the server"), qPrintable(refusal));
}

void ServerLoginTest::eachRefusalSaysWhatHelps_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("code");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("what");
    QTest::addColumn<QString>("helps");
    const auto row = [](const char* name, const char* text, const char* code, int exitCode, const char* what, const char* helps) {
        QTest::newRow(name) << text << code << exitCode << what << helps;
    };
    row("wrong password", "FATAL:  password authentication failed for user \"a\"", "28P01", 2, "user or password", "~/.pgpass");
    row("wrong password, in Chinese", "\u81f4\u547d\u9519\u8bef:  \u7528\u6237 \"a\" Password \u8ba4\u8bc1\u5931\u8d25", "28P01",
        2, "user or password", "~/.pgpass");
    row("a refusal that passed, in Chinese", "\u81f4\u547d\u9519\u8bef:  \u2026", "", 3, "refused a connection", "try again");
    row("no password", "connection to server at \"h\" failed: fe_sendauth: no password supplied", "", 2, "no password for this",
        "chmod 600 ~/.pgpass");
    row("no certificate", "FATAL:  connection requires a valid client certificate", "28000", 2, "refused this login",
        "sslcert=FILE");
    row("unknown user", "FATAL:  role \"a\" does not exist", "28000", 2, "refused this login", "ask who keeps the server");
    row("unknown database", "FATAL:  database \"x\" does not exist", "3D000", 2, "refused this login", "correct the database");
    row("a stand-by", "FATAL:  the database system is not accepting connections", "57P03", 3, "takes no connections now", "pair");
    row("too many", "FATAL:  sorry, too many clients already", "53300", 3, "too many connections", "close programs");
    row("no memory", "FATAL:  out of memory", "53200", 3, "takes no connections now", "ask who keeps the server");
    row("its disk", "FATAL:  could not read file \"base/1\"", "58030", 3, "takes no connections now", "ask who keeps the server");
    row("its operator", "FATAL:  terminating connection", "57P05", 3, "takes no connections now", "wait");
    row("its protocol", "FATAL:  server login has been failing", "08P01", 3, "takes no connections now", "wait");
    row("another code", "FATAL:  invalid value for parameter", "22023", 2, "refused this login", "~/.pgpass");
    row("stand-bys alone", "connection to server at \"h\" failed: server is in hot standby mode", "", 3, "takes entries",
        "PGTARGETSESSIONATTRS=any");
    row("certificate", "SSL error: certificate verify failed", "", 3, "is not accepted here", "the clock of this computer (2");
    row("another host", "server certificate for \"e\" does not match host name \"h\"", "", 3, "another server",
        "as the certificate");
    row("no authority", "root certificate file \"/r\" does not exist", "", 3, "authority cannot be read", "sslrootcert=FILE");
    row("open key", "private key file \"/k\" has group or world access", "", 3, "key of this login", "chmod 600 FILE");
    row("a typing error", "invalid sslmode value: \"verify-ful\"", "", 2, "setting of the address", "correct the address");
    row("unknown host", "could not translate host name \"alert.invalid\" to address", "", 3, "cannot be reached",
        "check the host");
    row("nobody there", "connection to server at \"h\" failed: Connection refused", "", 3, "cannot be reached",
        "check the network");
}

void ServerLoginTest::eachRefusalSaysWhatHelps()
{
    QFETCH(QString, text);
    QFETCH(QString, code);
    QFETCH(int, exitCode);
    QFETCH(QString, what);
    QFETCH(QString, helps);
    const QString fault = errorOf([&] { database::failLogin(text.toStdString(), code.toStdString(), "postgresql://a@h/x"); });
    QVERIFY2(fault.startsWith(QString::number(exitCode) + ": "), qPrintable(fault));
    QVERIFY2(fault.contains(what) && fault.contains(helps), qPrintable(fault));
    if (exitCode == 2) QVERIFY2(!fault.contains("check the network"), qPrintable(fault));
}

/// In a language that the program does not know, only the code says what the server means.
void ServerLoginTest::theServerGivesItsCode()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    const PrivateServer server;
    const auto codeFor = [&](const std::string& user, const std::string& database, int port) {
        const auto address = serverAddressFrom("postgresql://" + user + "@127.0.0.1:" + std::to_string(port) + "/" + database);
        return database::codeOfRefusal(connectionText(address, loginSettings(address, database::clientDefaults())));
    };
    QCOMPARE(codeFor("nobody", "lab", server.port()), std::string("28000"));
    QCOMPARE(codeFor("owner", "none", server.port()), std::string("3D000"));
    QCOMPARE(codeFor("owner", "lab", server.port()), std::string());
    QCOMPARE(codeFor("owner", "lab", 1), std::string());
    QVERIFY(
        errorOf([&] { database::ServerConnection(serverAddressFrom(server.address("x", "nobody"))); }).contains("refused this"));
}

QTEST_GUILESS_MAIN(ServerLoginTest)
#include "server_login_test.moc"
