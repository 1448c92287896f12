#include "protocols/process/computer_name.h"

#include <unistd.h>

#include <array>

namespace protocols {

std::string computerName()
{
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace protocols
