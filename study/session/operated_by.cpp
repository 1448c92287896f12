#include "study/session/operated_by.h"

#include <pwd.h>
#include <unistd.h>

#include <array>

namespace study::session {

namespace {

/// The full name of the account where it has one, with its login name: "Ada Lovelace (ada)".
std::string accountName()
{
    const passwd* account = ::getpwuid(::geteuid());
    if (account == nullptr) return "user " + std::to_string(::geteuid());
    const std::string login = account->pw_name == nullptr ? "" : account->pw_name;
    std::string full = account->pw_gecos == nullptr ? "" : account->pw_gecos;
    full = full.substr(0, full.find(','));
    return full.empty() || full == login ? login : full + " (" + login + ")";
}

std::string hostName()
{
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

OperatedBy operatedBy(const std::string& name, const std::string& program)
{
    return {name.empty() ? accountName() : name, program, hostName(), false};
}

}  // namespace study::session
