// Files and folders that vanish by themselves: a new folder in the system's temporary folder, and a file without a name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace protocols {

/// Folders for temporary files, absolute: the system's present one (TMPDIR), then /tmp, where a program with another TMPDIR may
/// have left files. Never empty.
std::vector<std::filesystem::path> temporaryPlaces();

/// Vanishes with all it holds, also where SIGINT, SIGTERM, SIGHUP, SIGQUIT or SIGPIPE ends the program.
class TemporaryFolder {
public:
    TemporaryFolder();  ///< throws environmentFault where no folder can be created
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
};

/// Removes the temporary folders that this process still has, for its very end: a thread that nobody waits for may hold one.
void removeLivingFolders();

/// An open file without a name in a folder. Nothing stays behind, whatever happens; but where the file system has no such files,
/// a killed program may leave one called like an unfinished file.
class NamelessFile {
public:
    explicit NamelessFile(const std::filesystem::path& folder);
    ~NamelessFile();
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;
    int descriptor() const { return m_descriptor; }  ///< -1 where it cannot be made; errno is then set

private:
    int m_descriptor;
    std::filesystem::path m_name;  ///< empty where it has none
};

/// Whether new files in a folder can be kept to their owner; some sticks and network shares keep no access rights. True where no
/// file can be made.
bool keepsAccessRights(const std::filesystem::path& folder);

/// Allocates bytes in a folder and gives them back at once: a quota of the account is not seen otherwise. Returns 0, or ENOSPC,
/// EDQUOT or EFBIG where they are refused.
int reasonAgainstRoom(const std::filesystem::path& folder, std::uintmax_t bytes);

}  // namespace protocols
