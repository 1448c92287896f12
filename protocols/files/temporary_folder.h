// A new folder in the system's temporary folder; it is deleted with this value.
#pragma once

#include <filesystem>

namespace protocols {

/// Vanishes with all it holds.
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

}  // namespace protocols
