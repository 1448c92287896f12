#include "protocols/files/open_files.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>

namespace protocols {

bool isTooManyOpenFiles(int reason) { return reason == EMFILE || reason == ENFILE; }

bool canOpenNoMoreFiles()
{
    const int descriptor = ::open("/", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return isTooManyOpenFiles(errno);
    ::close(descriptor);
    return false;
}

Error tooManyOpenFiles(const std::string& where)
{
    rlimit limit{};
    const bool isKnown = ::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    const std::string most = isKnown ? ", which is " + std::to_string(limit.rlim_cur) : "";
    return environmentFault({"cannot be opened, because this program may not open more files", where,
                             "a limit of open files of at least 256", "raise the limit" + most + ": `ulimit -n 1024`"});
}

}  // namespace protocols
