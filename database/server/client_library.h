// PostgreSQL's client library, which Qt's driver has loaded: what it would use where an address sets nothing, and why a server
// refused a login. Qt's driver gives neither.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace database {

/// What the client library takes from the environment, from a service file (PGSERVICE) and from its own defaults, by the name of
/// the setting; nullopt where the library cannot say.
std::optional<std::map<std::string, std::string>> clientDefaults();

/// Connects with these settings ("name='value' …") and returns the SQLSTATE with which the server refuses; empty where it does
/// not, or where the client ends the attempt itself.
std::string codeOfRefusal(const std::string& settings);

/// The process of the server that the client library was told when the connection began; 0 where it cannot say. `connection`: the
/// library's own, PGconn*.
int toldProcessOf(const void* connection);

/// While this lives, the client library's own messages on this thread are in English. Those of the server keep its language.
class EnglishMessages {
public:
    EnglishMessages();
    ~EnglishMessages();
    EnglishMessages(const EnglishMessages&) = delete;
    EnglishMessages& operator=(const EnglishMessages&) = delete;

private:
    void* m_english = nullptr;
    void* m_before = nullptr;
};

}  // namespace database
