#include "protocols/process/owner_only.h"

#include <sys/stat.h>
#include <sys/xattr.h>

#include <atomic>

namespace protocols {

namespace {

std::atomic<bool> isKept = false;

}  // namespace

void keepFilesToOwner()
{
    ::umask(0077);
    isKept = true;
}

bool filesAreKeptToOwner() { return isKept; }

void closeFolderToOthers(const std::filesystem::path& folder)
{
    (void)::removexattr(folder.c_str(), "system.posix_acl_default");
    (void)::chmod(folder.c_str(), 0700);
}

}  // namespace protocols
