// Folder of the shared recordings: VIS2HAP_SHARED, else ../shared beside the project. Tests that need the recordings
// skip with a message where they are missing.
#pragma once

#include <QString>
#include <QtGlobal>
#include <filesystem>

inline std::filesystem::path sharedData(const char* name)
{
    const QString shared = qEnvironmentVariable("VIS2HAP_SHARED", VIS2HAP_SOURCE_DIR "/../shared");
    return (shared + "/data/" + name).toStdString();
}
