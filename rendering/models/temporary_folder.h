// A folder of its own under the system's temporary one, gone with this value.
#pragma once

#include <filesystem>

namespace rendering::models {

class TemporaryFolder {
public:
    TemporaryFolder();  ///< throws environmentFault where none can be made
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
};

}  // namespace rendering::models
