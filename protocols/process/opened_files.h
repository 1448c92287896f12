// Which files are opened for reading while this value lives, as the kernel reports it (inotify): by this process, its children,
// or anybody else. For `--explain`, and for tests that nothing is read without use.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

namespace protocols {

class OpenedFiles {
public:
    /// Watches files, and folders with all folders below them. Leaves out what does not exist or cannot be watched.
    explicit OpenedFiles(const std::vector<std::filesystem::path>& places);
    ~OpenedFiles();
    OpenedFiles(const OpenedFiles&) = delete;
    OpenedFiles& operator=(const OpenedFiles&) = delete;

    /// How often each file was opened for reading and closed again, so far.
    const std::map<std::filesystem::path, int>& counts();

    /// False where more was opened than the kernel noted, or where a place could not be watched.
    bool isComplete() const { return m_isComplete; }

private:
    void watch(const std::filesystem::path& place);

    int m_queue;
    bool m_isComplete = true;
    std::map<int, std::filesystem::path> m_places;  ///< by the kernel's number
    std::map<std::filesystem::path, int> m_counts;
};

}  // namespace protocols
