#include "database/server/login_settings.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace database {

namespace {

// A cut network is noticed after these times, s and ms.
constexpr std::pair<const char*, const char*> timeLimits[] = {
    {"keepalives_idle", "5"}, {"keepalives_interval", "2"}, {"keepalives_count", "3"}, {"tcp_user_timeout", "5000"}};
// Seconds for each host. A station waits 4 s when it starts (ServerPatience), so a list must reach its second host before.
constexpr const char* untilOneHostCounts = "4";
constexpr const char* untilNextHost = "2";

constexpr const char* compiledMode = "prefer";
constexpr const char* compiledTarget = "any";

bool isInEnvironment(const char* variable)
{
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

/// 127.0.0.1 and its like; a name such as 127.lab.example is none.
bool isLoopback(const std::string& host)
{
    return host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos;
}

bool isThisComputer(const std::string& host)
{
    return host.empty() || host.starts_with('/') || host.starts_with('@') || host == "localhost" || isLoopback(host) ||
           host == "::1";
}

std::vector<std::string> hostsOf(const std::string& list)
{
    std::vector<std::string> hosts;
    std::istringstream stream(list);
    for (std::string host; std::getline(stream, host, ',');) hosts.push_back(host);
    return hosts;
}

class Effective {
public:
    Effective(const ServerAddress& address, const std::optional<std::map<std::string, std::string>>& defaults)
        : m_address(address), m_defaults(defaults)
    {
    }
    std::string value(const std::string& name) const
    {
        for (auto setting = m_address.settings.rbegin(); setting != m_address.settings.rend(); ++setting)
            if (setting->first == name) return setting->second;
        if (name == "host" && !m_address.host.empty()) return m_address.host;
        if (!m_defaults) return {};
        const auto found = m_defaults->find(name);
        return found == m_defaults->end() ? std::string() : found->second;
    }
    std::vector<std::string> hosts() const
    {
        const std::string numbers = value("hostaddr");
        return hostsOf(numbers.empty() ? value("host") : numbers);
    }
    bool isLocal() const
    {
        const auto all = hosts();
        if (all.empty()) return m_defaults.has_value();  // else the environment may name any host
        return std::ranges::all_of(all, isThisComputer);
    }
    bool hasChosenMode() const { return hasChosen("sslmode", "PGSSLMODE", compiledMode); }
    bool hasChosenTarget() const { return hasChosen("target_session_attrs", "PGTARGETSESSIONATTRS", compiledTarget); }

private:
    bool hasChosen(const char* name, const char* variable, const char* compiled) const
    {
        if (isInEnvironment(variable)) return true;
        const std::string chosen = value(name);
        const auto isIt = [&](const auto& setting) { return setting.first == name; };
        return std::ranges::any_of(m_address.settings, isIt) || (!chosen.empty() && chosen != compiled);
    }

    const ServerAddress& m_address;
    const std::optional<std::map<std::string, std::string>>& m_defaults;
};

}  // namespace

LoginSettings loginSettings(const ServerAddress& address, const std::optional<std::map<std::string, std::string>>& defaults)
{
    const Effective effective(address, defaults);
    LoginSettings settings(std::begin(timeLimits), std::end(timeLimits));
    const bool isList = effective.hosts().size() > 1;
    settings.emplace_back("connect_timeout", isList ? untilNextHost : untilOneHostCounts);
    // A stand-by that stands first in the list would take no entry of a station.
    if (isList && !effective.hasChosenTarget()) settings.emplace_back("target_session_attrs", "primary");
    if (!address.port.empty()) settings.emplace_back("port", address.port);
    settings.insert(settings.end(), address.settings.begin(), address.settings.end());
    // The client library would go on without encryption where the server offers none, and say nothing.
    if (!effective.hasChosenMode() && !effective.isLocal()) settings.emplace_back("sslmode", "require");
    return settings;
}

std::string quotedSetting(const std::string& value)
{
    std::string quoted = "'";
    for (const char c : value) {
        if (c == '\\' || c == '\'') quoted += '\\';
        quoted += c;
    }
    return quoted + "'";
}

std::string connectionText(const ServerAddress& address, const LoginSettings& settings)
{
    std::string text = "dbname=" + quotedSetting(address.database);
    if (!address.host.empty()) text += " host=" + quotedSetting(address.host);
    if (!address.user.empty()) text += " user=" + quotedSetting(address.user);
    for (const auto& [name, value] : settings) text += " " + name + "=" + quotedSetting(value);
    return text;
}

}  // namespace database
