// The environment of programs that this one starts and that need no secret.
#pragma once

#include <QProcessEnvironment>

#include "protocols/secrets/secret_variables.h"

namespace study::commands {

inline QProcessEnvironment environmentWithoutSecrets()
{
    QProcessEnvironment surroundings = QProcessEnvironment::systemEnvironment();
    for (const char* secret : protocols::secretVariables) surroundings.remove(QLatin1String(secret));
    return surroundings;
}

}  // namespace study::commands
