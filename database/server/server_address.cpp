#include "database/server/server_address.h"

#include <QUrl>
#include <QUrlQuery>
#include <algorithm>
#include <string_view>

#include "protocols/files/errors.h"
#include "protocols/files/utf8.h"

namespace database {

namespace {

constexpr const char* form = "postgresql://USER@HOST/DATABASE?study=NAME";
constexpr std::size_t longestName = 40;  // PostgreSQL cuts the names of its schemas and roles at 63 bytes

bool isStudyName(const std::string& name)
{
    return !name.empty() && name.size() <= longestName && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
}

void requireStudyName(const std::string& name, const std::string& where)
{
    if (!isStudyName(name))
        throw protocols::badInput({"\"" + name + "\" cannot name a study on a server", where,
                                   "at most 40 small letters, digits, - and _", "change study=NAME"});
}

/// What an address may set of PostgreSQL's client library. Passwords stand in ~/.pgpass, because the address is stored, printed
/// and exported.
constexpr std::string_view knownSettings[] = {"sslmode",
                                              "sslrootcert",
                                              "sslcert",
                                              "sslkey",
                                              "sslcrl",
                                              "sslcrldir",
                                              "sslsni",
                                              "ssl_min_protocol_version",
                                              "ssl_max_protocol_version",
                                              "channel_binding",
                                              "gssencmode",
                                              "krbsrvname",
                                              "gsslib",
                                              "hostaddr",
                                              "connect_timeout",
                                              "keepalives",
                                              "keepalives_idle",
                                              "keepalives_interval",
                                              "keepalives_count",
                                              "tcp_user_timeout",
                                              "target_session_attrs",
                                              "requirepeer",
                                              "passfile",
                                              "application_name"};

constexpr const char* passwordPlace = "put the password into ~/.pgpass or the environment variable PGPASSWORD";

/// Qt's driver reads a semicolon as the end of a setting, in quotes, too.
void requireNoSemicolon(const std::string& name, const std::string& value, const std::string& where)
{
    if (value.find(';') != std::string::npos)
        throw protocols::badInput({"the value of " + name + " holds a semicolon", where, "a value without one",
                                   "give the file or folder another name"});
}

/// Qt changes such characters on their way into another address. Unicode assigns none of them to a letter.
bool hasNonCharacter(const std::string& part)
{
    return std::ranges::any_of(QString::fromStdString(part).toUcs4(), [](uint one) { return QChar::isNonCharacter(one); });
}

void requireVisible(const std::string& part, const std::string& where)
{
    if (!protocols::isKeptText(part) || hasNonCharacter(part))
        throw protocols::badInput({"the address holds a character that nobody sees", where, form, "type the address again"});
}

/// The places of a text that may hold a password: from the first ":" after "//" to the last "@".
std::pair<std::size_t, std::size_t> secretIn(const std::string& text)
{
    const auto begin = text.find("//");
    const auto colon = text.find(':', begin == std::string::npos ? 0 : begin + 2), end = text.rfind('@');
    if (colon == std::string::npos || end == std::string::npos || end < colon) return {0, 0};
    return {colon, end};
}

/// `what`: the fault of an address that cannot be read. Where it may hold a password, the message shows neither that nor what was
/// read in its place.
protocols::Error unreadableAddress(const std::string& what, const std::string& text, const std::string& next)
{
    if (withoutPassword(text) != text)
        return protocols::badInput({"this is no address of a server, and it may hold a password", withoutPassword(text), form,
                                    std::string("correct the address; ") + passwordPlace});
    return protocols::badInput({what, withoutPassword(text), form, next});
}

void requireKnownSetting(const std::string& name, const std::string& text)
{
    if (std::ranges::find(knownSettings, name) != std::end(knownSettings)) return;
    if (name == "password" || name == "sslpassword")
        throw protocols::badInput({"the address holds a password, which would stay in the notes of the study",
                                   "setting \"" + name + "\"", form, passwordPlace});
    if (withoutPassword(text) != text) throw unreadableAddress("this is no address of a server", text, "correct the address");
    throw protocols::badInput({"the setting \"" + name + "\" is unknown in an address", "address of the server",
                               "study, host, port, user, sslmode, sslrootcert and the like", "take it out of the address"});
}

}  // namespace

std::string withoutPassword(const std::string& text)
{
    const auto [begin, end] = secretIn(text);
    std::string shown = begin == end ? text : text.substr(0, begin) + text.substr(end);
    constexpr std::string_view name = "password=";  // of sslpassword, too
    for (auto at = shown.find(name); at != std::string::npos; at = shown.find(name, at + name.size())) {
        const auto from = at + name.size();
        shown.erase(from, std::min(shown.find('&', from), shown.size()) - from);
    }
    return shown;
}

bool isServerAddress(const std::string& text) { return text.starts_with("postgresql://") || text.starts_with("postgres://"); }

ServerAddress serverAddressFrom(const std::string& text)
{
    const QUrl url(QString::fromStdString(text), QUrl::StrictMode);
    if (!isServerAddress(text) || !url.isValid())
        throw unreadableAddress("this is no address of a server", text, "correct the address");
    if (!url.password().isEmpty())
        throw protocols::badInput({"the address holds a password, which would stay in the notes of the study",
                                   withoutPassword(text), form, passwordPlace});
    ServerAddress address{text, url.host().toStdString(), {}, url.path().mid(1).toStdString(), url.userName().toStdString(), {},
                          {}};
    if (url.port() > 0) address.port = std::to_string(url.port());
    for (const auto& [name, value] : QUrlQuery(url).queryItems(QUrl::FullyDecoded)) {
        const std::string setting = name.toStdString();
        if (setting == "study")
            address.study = value.toStdString();
        else if (setting == "host")
            address.host = value.toStdString();
        else if (setting == "port")
            address.port = value.toStdString();
        else if (setting == "user")
            address.user = value.toStdString();
        else {
            requireKnownSetting(setting, text);
            address.settings.emplace_back(setting, value.toStdString());
        }
    }
    for (const auto& [name, value] : address.settings) requireNoSemicolon(name, value, withoutPassword(text));
    requireNoSemicolon("port", address.port, withoutPassword(text));
    for (const auto* part : {&address.host, &address.port, &address.database, &address.user})
        requireVisible(*part, withoutPassword(text));
    for (const auto& [name, value] : address.settings) requireVisible(value, withoutPassword(text));
    if (address.database.empty() || address.database.find_first_of("/@") != std::string::npos)
        throw unreadableAddress("the address names no database", text, "name the database after the host");
    if (!address.study.empty()) requireStudyName(address.study, withoutPassword(text));
    return address;
}

std::string addressOfStudy(const ServerAddress& address, const std::string& study)
{
    if (address.study == study) return address.text;
    requireStudyName(study, address.text);
    QUrl url(QString::fromStdString(address.text));
    QUrlQuery query(url);
    query.removeAllQueryItems(QStringLiteral("study"));
    query.addQueryItem(QStringLiteral("study"), QString::fromStdString(study));
    url.setQuery(query);
    return url.toString(QUrl::FullyEncoded).toStdString();
}

}  // namespace database
