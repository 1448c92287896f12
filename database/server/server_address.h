// The address of a study on a server: postgresql://USER@HOST:PORT/DATABASE?study=NAME. Further settings are those of PostgreSQL's
// own client library, such as sslmode=verify-full or host=/run/postgresql for a socket of this computer.
#pragma once

#include <string>
#include <vector>

namespace database {

struct ServerAddress {
    std::string text;  ///< as it was given
    std::string host, port, database, user;
    std::string study;                                          ///< empty: the only one of the database
    std::vector<std::pair<std::string, std::string>> settings;  ///< for the client library
};

/// Whether a text stands where a folder may stand, and means a server.
bool isServerAddress(const std::string& text);

/// Throws badInput for another scheme, a missing database, a study's name that is no id, a setting that is not known, and a
/// password, which belongs into a file of PostgreSQL's (~/.pgpass) and not into the notes of a study.
ServerAddress serverAddressFrom(const std::string& text);

/// The address for a message: without what stands between the first ":" and the last "@", which may hold a password.
std::string withoutPassword(const std::string& text);

/// The address with this study.
std::string addressOfStudy(const ServerAddress& address, const std::string& study);

}  // namespace database
