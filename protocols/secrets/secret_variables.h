// Variables of the environment with secrets. Programs that this one starts do not get them, unless they need one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace protocols {

/// Whether a variable holds a secret: "NAME" or "NAME=VALUE".
bool isSecretVariable(std::string_view variable);

/// The variables of this process without the secrets, "NAME=VALUE".
std::vector<std::string> environmentWithoutSecrets();

/// The same of a value that names its variables by keys(), as Qt's QProcessEnvironment does.
template <class Variables>
Variables withoutSecrets(Variables variables)
{
    for (const auto& name : variables.keys())
        if (isSecretVariable(name.toStdString())) variables.remove(name);
    return variables;
}

}  // namespace protocols
