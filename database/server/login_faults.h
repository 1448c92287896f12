// Why no connection came about, and what helps.
#pragma once

#include <string>

namespace database {

/// Throws badInput for a wrong login or setting, environmentFault for a fault of encryption, and ServerAway where a
/// later attempt may succeed. `text`: the client library's message, its own words in English. `code`: the server's SQLSTATE,
/// empty where the client ended the attempt.
[[noreturn]] void failLogin(const std::string& text, const std::string& code, const std::string& where);

/// Whether the message comes from the server: "SEVERITY:  text" in any language.
bool isFromServer(const std::string& text);

}  // namespace database
