// Checks of the computer before a session: the disk that keeps the answers, and the clocks.
#pragma once

#include <QString>
#include <filesystem>
#include <string>

namespace study::app {

/// What is wrong with the disk of this folder, as a sentence; empty if nothing is. It needs 100 MB of room, and 20 short writes
/// must reach the disk, the slowest within 200 ms. Leaves no file behind.
QString faultOfDisk(const std::filesystem::path& folder);

/// What is wrong with the file of this folder that keeps the answers; empty if it is there. As it closes, an open study whose
/// file was removed keeps its answers in a rescue file.
QString faultOfDatabase(const std::filesystem::path& database);

/// What is wrong with the clocks, as a sentence; empty if nothing is. `lastWallTime`: the latest time that the study holds, ISO
/// 8601: the computer's clock must not be behind it.
QString faultOfClocks(const std::string& lastWallTime);

}  // namespace study::app
