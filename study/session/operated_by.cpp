#include "study/session/operated_by.h"

#include <pwd.h>
#include <unistd.h>

#include "protocols/files/id_rule.h"
#include "protocols/process/computer_name.h"

namespace study::session {

namespace {

bool isGoodName(const std::string& name) { return protocols::faultOfLine(name, protocols::longestName).empty(); }

/// The full name of the account where it has one, with its login name: "Ada Lovelace (ada)". Names that break the rule for names
/// are left out.
std::string accountName()
{
    const std::string number = "user " + std::to_string(::geteuid());
    const passwd* account = ::getpwuid(::geteuid());
    if (account == nullptr) return number;
    const std::string login = account->pw_name == nullptr ? "" : account->pw_name;
    std::string full = account->pw_gecos == nullptr ? "" : account->pw_gecos;
    full = full.substr(0, full.find(','));
    const std::string both = full + " (" + login + ")";
    if (!full.empty() && full != login && isGoodName(both)) return both;
    return isGoodName(login) ? login : number;
}

}  // namespace

OperatedBy operatedBy(const std::string& name, const std::string& program)
{
    return {name.empty() ? accountName() : name, program, protocols::computerName(), false, {}};
}

}  // namespace study::session
