// Where the shared recordings are: VIS2HAP_SHARED, else ../shared beside the project. Tests that need them skip aloud where
// they are not there.
#pragma once

#include <QString>
#include <QtGlobal>
#include <filesystem>

inline std::filesystem::path sharedData(const char* name)
{
    const QString shared = qEnvironmentVariable("VIS2HAP_SHARED", VIS2HAP_SOURCE_DIR "/../shared");
    return (shared + "/data/" + name).toStdString();
}
