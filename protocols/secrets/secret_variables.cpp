#include "protocols/secrets/secret_variables.h"

#include <unistd.h>

#include <algorithm>

extern char** environ;  // NOLINT: declared by the C library.

namespace protocols {

namespace {

constexpr std::string_view secretNames[] = {"VIS2HAP_PASSPHRASE", "PGPASSWORD"};

}  // namespace

bool isSecretVariable(std::string_view variable)
{
    return std::ranges::find(secretNames, variable.substr(0, variable.find('='))) != std::end(secretNames);
}

std::vector<std::string> environmentWithoutSecrets()
{
    std::vector<std::string> variables;
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable)
        if (!isSecretVariable(*variable)) variables.emplace_back(*variable);
    return variables;
}

}  // namespace protocols
