#include "study/leaks/cache_marks.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "protocols/files/errors.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"

namespace study::leaks {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t readFromBeginning = std::size_t{1} << 16;

struct CacheEntry {
    struct stat status {};
    double changed() const { return secondsOf(status.st_ctim); }
    double used() const { return secondsOf(status.st_mtim); }

private:
    static double secondsOf(const timespec& time)
    {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
    }
};

std::vector<CacheEntry> entriesOf(const fs::path& cache)
{
    std::vector<CacheEntry> entries;
    std::error_code ignored;
    for (const auto& file : fs::directory_iterator(cache, ignored)) {
        CacheEntry entry;
        if (::stat(file.path().c_str(), &entry.status) == 0 && S_ISREG(entry.status.st_mode)) entries.push_back(entry);
    }
    return entries;
}

std::vector<std::string> codesOfStimuli(const fs::path& stimuli)
{
    std::vector<std::string> codes;
    std::error_code ignored;
    for (const auto& file : fs::directory_iterator(stimuli, ignored)) codes.push_back(file.path().stem().string());
    std::ranges::sort(codes);
    return codes;
}

/// The text before the first byte of an array. Among some hundred codes, one of three or four characters stands in the bytes of
/// arrays by chance.
std::string_view textBefore(std::string_view bytes)
{
    const auto isOfArray = [](char c) { return (c >= 0 && c < ' ' && c != '\n' && c != '\t' && c != '\r') || c == 0x7F; };
    const auto end = static_cast<std::size_t>(std::ranges::find_if(bytes, isOfArray) - bytes.begin());
    return bytes.substr(0, std::min(end, protocols::firstByteThatIsNotUtf8(bytes).value_or(bytes.size())));
}

/// A number of JSON, such as a width: three digits after a colon, a comma or a bracket are no code.
bool isJsonNumber(const std::string& text, std::size_t at, const std::string& code)
{
    if (!std::ranges::all_of(code, [](unsigned char c) { return std::isdigit(c) != 0; })) return false;
    const std::size_t before = at == 0 ? std::string::npos : text.find_last_not_of(" \n", at - 1);
    return before != std::string::npos && (text[before] == ':' || text[before] == ',' || text[before] == '[');
}

/// Whether the text holds the code as a word of its own: the digits of a code are no news within those of a long number.
bool holdsWord(const std::string& text, const std::string& code)
{
    const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-'; };
    for (auto at = text.find(code); at != std::string::npos; at = text.find(code, at + 1)) {
        const std::size_t end = at + code.size();
        const bool isWord = (at == 0 || !isPart(text[at - 1])) && (end == text.size() || !isPart(text[end]));
        if (isWord && !isJsonNumber(text, at, code)) return true;
    }
    return false;
}

}  // namespace

std::vector<FileMark> marksOfCache(const fs::path& cache, const fs::path& stimuli)
{
    const auto codes = codesOfStimuli(stimuli);
    auto entries = entriesOf(cache);
    if (codes.empty() || entries.size() < codes.size()) return {};
    std::vector<FileMark> marks;
    const std::pair<const char*, double (CacheEntry::*)() const> orders[] = {{"last change", &CacheEntry::changed},
                                                                             {"last use", &CacheEntry::used}};
    for (const auto& [order, timeOf] : orders) {
        std::ranges::sort(entries, {}, [time = timeOf](const CacheEntry& entry) { return (entry.*time)(); });
        const std::size_t first = entries.size() - codes.size();
        FileMark size{std::string("size of the cache's entry at the same place by ") + order, {}},
            step{std::string("time after the entry before it, by ") + order, {}};
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const CacheEntry& entry = entries[first + i];
            size.values[codes[i]] = static_cast<double>(entry.status.st_size);
            step.values[codes[i]] = first + i == 0 ? 0 : (entry.*timeOf)() - (entries[first + i - 1].*timeOf)();
        }
        marks.push_back(std::move(size));
        marks.push_back(std::move(step));
    }
    return marks;
}

std::vector<std::string> codesInCache(const fs::path& cache, const std::set<std::string>& codes)
{
    std::vector<std::string> lines;
    std::error_code ignored;
    for (const auto& file : fs::directory_iterator(cache, ignored)) {
        std::string text = file.path().filename().string() + "\n";
        try {
            text += textBefore(protocols::beginningOf(file.path(), readFromBeginning));
        } catch (const protocols::Error&) {
            continue;  // removed meanwhile, or no file
        }
        const bool names = std::ranges::any_of(codes, [&](const auto& code) { return holdsWord(text, code); });
        if (names) lines.push_back("the cache of signals names a code of the study: " + file.path().filename().string());
    }
    std::ranges::sort(lines);
    return lines;
}

}  // namespace study::leaks
