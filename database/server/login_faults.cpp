#include "database/server/login_faults.h"

#include <QDate>
#include <algorithm>
#include <string_view>

#include "database/server/server_connection.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

enum class LoginFaultKind { Login, Encryption, Away };

struct LoginFault {
    std::string_view sign;  ///< a code of the server, or words of the client library
    LoginFaultKind kind;
    const char *what, *expected, *next;  ///< what: followed by the words of the server or the library
};

constexpr const char* passwordLine =
    "put the line HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass, and close the file to others: chmod 600 ~/.pgpass";
constexpr const char* ownCertificate = "name the certificate of this login in the address: sslcert=FILE and sslkey=FILE";

// PostgreSQL manual, appendix A.
constexpr LoginFault refusals[] = {
    {"28P01", LoginFaultKind::Login, "the server refused user or password: ", "a user and a password that the server knows",
     passwordLine},
    {"28000", LoginFaultKind::Login, "the server refused this login: ", "a login that pg_hba.conf of the server lets in",
     "ask who keeps the server; where it wants a certificate of the login: sslcert=FILE and sslkey=FILE in the address"},
    {"3D000", LoginFaultKind::Login, "the server refused this login: ", "a database of the server",
     "correct the database in the address"},
    {"42501", LoginFaultKind::Login, "the server refused this login: ", "a login with the right CONNECT to the database",
     "ask who keeps the server"},
    {"53300", LoginFaultKind::Away, "the server has too many connections: ", "a free one of its max_connections",
     "close programs that are connected, or ask who keeps the server for more"},
    {"57P01", LoginFaultKind::Away, "the server stops: ", "", "wait until it has started again"},
    {"57P02", LoginFaultKind::Away, "the server stops: ", "", "wait until it has started again"},
    {"57P03", LoginFaultKind::Away, "the server takes no connections now: ", "a server that has started and is no stand-by",
     "wait until it has started; of a pair of servers, name the one that takes entries"}};

constexpr LoginFault endedByClient[] = {
    {"no password supplied", LoginFaultKind::Login, "there is no password for this login: ",
     "the password in ~/.pgpass, which nobody else can read, or in PGPASSWORD", passwordLine},
    {"does not support SSL", LoginFaultKind::Encryption, "the server does not encrypt: ", "a server with ssl = on",
     "let its administrator switch it on; sslmode=prefer in the address goes on without, for everybody to read"},
    {"certificate verify failed", LoginFaultKind::Encryption, "the certificate of the server is not accepted here: ",
     "one that the authority in sslrootcert has signed, and that is valid today",
     "check sslrootcert=FILE, the dates of the certificate and the clock of this computer"},
    {"does not match host name", LoginFaultKind::Encryption, "the certificate belongs to another server: ",
     "the host of the address in the certificate", "write the host as the certificate names it, or ask who keeps the server"},
    {"root certificate", LoginFaultKind::Encryption, "the certificate of the lab's authority cannot be read: ",
     "the file that signed the server's certificate", "name it in the address: sslrootcert=FILE"},
    {"private key", LoginFaultKind::Encryption, "the key of this login cannot be used: ", "a key that nobody else can read",
     "check sslkey=FILE and close it to others: chmod 600 FILE"},
    {"certificate required", LoginFaultKind::Encryption, "the server wants a certificate of this login: ", "", ownCertificate},
    {"alert", LoginFaultKind::Encryption, "the server refused the encryption: ", "a certificate of this login that it knows",
     ownCertificate},
    {"certificate", LoginFaultKind::Encryption, "a certificate cannot be used: ", "", "check sslcert=FILE and sslkey=FILE"},
    {"definition of service", LoginFaultKind::Login, "the service is unknown: ", "a service of the service file",
     "correct PGSERVICE, or ~/.pg_service.conf"},
    {"service file", LoginFaultKind::Login, "the service file cannot be read: ", "", "correct ~/.pg_service.conf"},
    {"invalid", LoginFaultKind::Login, "a setting of the address is wrong: ", "", "correct the address"},
    {"could not match", LoginFaultKind::Login, "hosts and ports do not agree: ", "one port, or one for each host",
     "correct the address"},
    {"session is read-only", LoginFaultKind::Away, "no server of the list takes entries: ", "a server that is no stand-by",
     "wait until one takes them; with PGTARGETSESSIONATTRS=any a stand-by answers commands that only read"},
    {"is in hot standby mode", LoginFaultKind::Away, "no server of the list takes entries: ", "a server that is no stand-by",
     "wait until one takes them; with PGTARGETSESSIONATTRS=any a stand-by answers commands that only read"},
    {"translate host name", LoginFaultKind::Away, "the server cannot be reached: ", "a host that this network knows",
     "check the host in the address, and the network"}};

/// Classes of codes that say nothing of this login: the way, the resources of the server, its operator, its system.
constexpr std::string_view passingClasses[] = {"08", "53", "57", "58"};

/// As one line, without the words that name the severity.
std::string oneLine(const std::string& text)
{
    std::string line;
    for (const char c : text) {
        const char shown = c == '\n' || c == '\t' ? ' ' : c;
        if (shown != ' ' || !line.ends_with(' ')) line += shown;
    }
    while (line.ends_with(' ')) line.pop_back();
    return line;
}

/// Names of hosts, files and users may be any words.
std::string withoutNames(const std::string& text)
{
    std::string words;
    bool isName = false;
    for (const char c : text) {
        if (c == '"') isName = !isName;
        if (!isName) words += c;
    }
    return words;
}

[[noreturn]] void failAs(const LoginFault& fault, const std::string& text, const std::string& where)
{
    std::string next = fault.next;
    if (fault.sign == "certificate verify failed") next += " (" + QDate::currentDate().toString(Qt::ISODate).toStdString() + ")";
    const protocols::Fault shown{fault.what + oneLine(text), where, fault.expected, next};
    switch (fault.kind) {
        case LoginFaultKind::Login:
            throw protocols::badInput(shown);
        case LoginFaultKind::Encryption:
            throw protocols::environmentFault(shown);
        case LoginFaultKind::Away:
            break;
    }
    throw ServerAway(shown);
}

}  // namespace

bool isFromServer(const std::string& text) { return text.find(":  ") != std::string::npos; }

void failLogin(const std::string& text, const std::string& code, const std::string& where)
{
    const std::string words = withoutNames(text);
    if (!code.empty() || isFromServer(text)) {
        if (code == "28000" && words.find("certificate") != std::string::npos)
            failAs(
                {code, LoginFaultKind::Login, "the server refused this login: ", "a certificate of this login", ownCertificate},
                text, where);
        if (code.empty())  // the second connection, which asks for the code, met another server than the first one
            failAs(
                {"", LoginFaultKind::Away, "the server refused a connection: ", "", "try again; then ask who keeps the server"},
                text, where);
        const auto found = std::ranges::find(refusals, std::string_view(code), &LoginFault::sign);
        if (found != std::end(refusals)) failAs(*found, text, where);
        if (std::ranges::find(passingClasses, std::string_view(code).substr(0, 2)) != std::end(passingClasses))
            failAs({code, LoginFaultKind::Away, "the server takes no connections now: ", "",
                    "wait; if this stays, ask who keeps the server"},
                   text, where);
        failAs({code, LoginFaultKind::Login, "the server refused this login: ",
                "a user, a password and a database that the server knows", "see ~/.pgpass, or ask who keeps the server"},
               text, where);
    }
    for (const LoginFault& fault : endedByClient)
        if (words.find(fault.sign) != std::string::npos) failAs(fault, text, where);
    failAs({"", LoginFaultKind::Away, "the server cannot be reached: ", "", "check the network and the server"}, text, where);
}

}  // namespace database
