#include "protocols/files/unfinished.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>
#include <vector>

#include "protocols/process/computer_name.h"

namespace protocols {

namespace {

namespace fs = std::filesystem;

std::string beginningOf(const fs::path& place) { return "." + place.filename().string() + ".unfinished-" + computerName() + "-"; }

bool isOfADeadProcess(std::string_view digits)
{
    pid_t process = 0;
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
    if (problem != std::errc{} || end != digits.data() + digits.size() || process <= 0) return false;
    return ::kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

fs::path unfinishedName(const fs::path& place)
{
    fs::path name = place;
    return name.replace_filename(beginningOf(place) + std::to_string(::getpid()));
}

void removeAbandoned(const fs::path& place)
{
    const std::string beginning = beginningOf(place);
    const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
    std::error_code problem;
    std::vector<fs::path> abandoned;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(beginning) && isOfADeadProcess(std::string_view(name).substr(beginning.size())))
            abandoned.push_back(entry->path());
    }
    for (const fs::path& item : abandoned) fs::remove_all(item, problem);
}

}  // namespace protocols
