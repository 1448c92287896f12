#include "protocols/files/temporary_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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

NamelessFile::NamelessFile(const std::filesystem::path& folder)
    : m_descriptor(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600))
{
    if (m_descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return;
    // Sticks and network shares have no files without a name.
    const std::string end = "-" + std::to_string(::getpid());
    std::string name = (folder / ".study.db.unfinished-XXXXXX").string() + end;
    m_descriptor = ::mkostemps(name.data(), static_cast<int>(end.size()), O_CLOEXEC);
    if (m_descriptor >= 0 && ::unlink(name.c_str()) != 0) m_name = name;  // some shares keep it until it is closed
}

NamelessFile::~NamelessFile()
{
    if (m_descriptor >= 0) ::close(m_descriptor);
    if (!m_name.empty()) ::unlink(m_name.c_str());
}

bool keepsAccessRights(const std::filesystem::path& folder)
{
    const NamelessFile file(folder);
    struct stat status {};
    return file.descriptor() < 0 || ::fstat(file.descriptor(), &status) != 0 || (status.st_mode & 077U) == 0;
}

int reasonAgainstRoom(const std::filesystem::path& folder, std::uintmax_t bytes)
{
    const NamelessFile file(folder);
    if (file.descriptor() < 0) return errno == EDQUOT || errno == ENOSPC ? errno : 0;
    int reason = ::posix_fallocate(file.descriptor(), 0, static_cast<off_t>(bytes));
    // A network share reports a refusal only when the bytes are sent to it.
    if (reason == 0 && ::fsync(file.descriptor()) != 0) reason = errno;
    return reason == ENOSPC || reason == EDQUOT || reason == EFBIG ? reason : 0;
}

}  // namespace protocols
