// What a connection asks of PostgreSQL's client library: the address, time limits, and encryption where the way is not local.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "database/server/server_address.h"

namespace database {

using LoginSettings = std::vector<std::pair<std::string, std::string>>;

/// By name and value, without host, database and user; a later value of a name counts. `defaults`: clientDefaults(), so
/// environment and service file. What they or the address say of encryption is never weakened: `sslmode` is added only where
/// nobody has chosen one and the server is on another computer. A list of servers gets target_session_attrs=primary, unless they
/// or the address choose another.
LoginSettings loginSettings(const ServerAddress& address, const std::optional<std::map<std::string, std::string>>& defaults);

/// The settings with host, database and user as the client library reads them: name='value' …
std::string connectionText(const ServerAddress& address, const LoginSettings& settings);

/// The value in the client library's quotes.
std::string quotedSetting(const std::string& value);

}  // namespace database
