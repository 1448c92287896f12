// A folder for this run only, under the system's temporary folder. Nothing in it is synced.
#pragma once

#include <filesystem>

namespace protocols {

/// Vanishes with all it holds.
class TemporaryFolder {
public:
    TemporaryFolder();  ///< throws environmentFault
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
};

}  // namespace protocols
