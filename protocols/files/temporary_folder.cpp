#include "protocols/files/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "protocols/files/errors.h"

namespace protocols {

TemporaryFolder::TemporaryFolder()
{
    std::error_code fault;
    std::filesystem::path parent = std::filesystem::temp_directory_path(fault);
    if (fault) parent = "/tmp";
    std::string name = (parent / "vis2hap-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw environmentFault({std::string("a temporary folder cannot be created: ") + std::strerror(errno), parent.string(),
                                "a writable folder with free space", "free space or set TMPDIR"});
    m_path = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

}  // namespace protocols
