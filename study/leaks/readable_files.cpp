#include "study/leaks/readable_files.h"

#include <sys/stat.h>

#include <QByteArray>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "protocols/condition.h"
#include "protocols/files/whole_file.h"

namespace study::leaks {

namespace {

namespace fs = std::filesystem;

struct SeenFile {
    std::string code;
    struct stat status {};
    double place = 0;  ///< in the order of the folder
    double compressed = 0, entropy = 0;
    double rank = 0;  ///< of the name
};

/// Bits per byte.
double entropyOf(const std::string& bytes)
{
    std::array<double, 256> counts{};
    for (const char byte : bytes) ++counts[static_cast<unsigned char>(byte)];
    double bits = 0;
    for (const double count : counts)
        if (count > 0) bits -= count / static_cast<double>(bytes.size()) * std::log2(count / static_cast<double>(bytes.size()));
    return bits;
}

std::vector<SeenFile> filesIn(const fs::path& stimuli)
{
    std::vector<SeenFile> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(stimuli, ignored)) {
        SeenFile file;
        file.code = entry.path().stem().string();
        file.place = static_cast<double>(files.size());
        if (::stat(entry.path().c_str(), &file.status) != 0 || !S_ISREG(file.status.st_mode)) continue;
        const std::string bytes = protocols::readIfPossible(entry.path()).value_or("");
        file.compressed = static_cast<double>(qCompress(QByteArray::fromStdString(bytes)).size());
        file.entropy = entropyOf(bytes);
        files.push_back(file);
    }
    std::ranges::sort(files, {}, &SeenFile::code);
    for (std::size_t i = 0; i < files.size(); ++i) files[i].rank = static_cast<double>(i);
    return files;
}

double nanoseconds(const timespec& time) { return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec); }

/// Whether `word` stands in the text with a delimiter of a cell or of an element at both sides.
bool holdsCell(const std::string& text, const std::string& word)
{
    constexpr std::string_view delimiters = "\",;\t\r\n<>&";
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool before = at == 0 || delimiters.find(text[at - 1]) != std::string_view::npos;
        const bool after = end == text.size() || delimiters.find(text[end]) != std::string_view::npos;
        if (before && after) return true;
    }
    return false;
}

}  // namespace

std::vector<FileMark> marksOfStimuli(const fs::path& stimuli)
{
    const std::vector<std::pair<const char*, std::function<double(const SeenFile&)>>> numbers{
        {"size", [](const SeenFile& file) { return static_cast<double>(file.status.st_size); }},
        {"time of the last change", [](const SeenFile& file) { return nanoseconds(file.status.st_mtim); }},
        {"time of the last change of its status", [](const SeenFile& file) { return nanoseconds(file.status.st_ctim); }},
        {"time of the last reading", [](const SeenFile& file) { return nanoseconds(file.status.st_atim); }},
        {"number of the inode", [](const SeenFile& file) { return static_cast<double>(file.status.st_ino); }},
        {"place in the folder", [](const SeenFile& file) { return file.place; }},
        {"blocks on the disk", [](const SeenFile& file) { return static_cast<double>(file.status.st_blocks); }},
        {"compressed size (zlib)", [](const SeenFile& file) { return file.compressed; }},
        {"entropy of the bytes", [](const SeenFile& file) { return file.entropy; }},
        {"place of the name in the alphabet", [](const SeenFile& file) { return file.rank; }},
    };
    const auto files = filesIn(stimuli);
    std::vector<FileMark> marks;
    for (const auto& [name, of] : numbers) {
        FileMark mark{name, {}};
        for (const SeenFile& file : files) mark.values[file.code] = of(file);
        marks.push_back(std::move(mark));
    }
    return marks;
}

std::vector<std::string> differencesOfStimuli(const fs::path& stimuli)
{
    constexpr double leastCompression = 0.98;
    std::set<double> sizes, times;
    std::size_t compressible = 0;
    const auto files = filesIn(stimuli);
    for (const SeenFile& file : files) {
        sizes.insert(static_cast<double>(file.status.st_size));
        times.insert(nanoseconds(file.status.st_mtim));
        compressible += file.compressed < leastCompression * static_cast<double>(file.status.st_size);
    }
    std::vector<std::string> lines;
    if (sizes.size() > 1) lines.push_back("the stimuli have " + std::to_string(sizes.size()) + " different sizes");
    if (times.size() > 1) lines.push_back("the stimuli have " + std::to_string(times.size()) + " different time stamps");
    if (compressible > 0) lines.push_back(std::to_string(compressible) + " stimuli can be compressed: their content shows");
    return lines;
}

std::vector<std::string> openModes(const fs::path& study)
{
    std::vector<std::string> lines;
    const auto check = [&](const fs::path& path) {
        struct stat status {};
        if (::lstat(path.c_str(), &status) != 0 || S_ISLNK(status.st_mode)) return;
        const unsigned mode = status.st_mode & 0777U;
        if ((mode & 077U) == 0) return;
        char text[8];
        std::snprintf(text, sizeof text, "%04o", mode);
        const fs::path name = path == study ? study.filename() : path.lexically_relative(study);
        lines.push_back(name.string() + " has mode " + text + " (expected " + (S_ISDIR(status.st_mode) ? "0700" : "0600") + ")");
    };
    check(study);
    std::error_code ignored;
    for (const auto& entry : fs::recursive_directory_iterator(study, ignored)) check(entry.path());
    std::ranges::sort(lines);
    return lines;
}

std::vector<std::string> namedInTexts(const fs::path& folder, const protocols::Protocol& protocol)
{
    std::vector<std::string> words{"correct", protocols::catchTrialId().value};
    for (std::size_t i = 0; i < protocol.conditions.size(); ++i) {
        words.push_back(protocol.conditions[i].value);
        words.push_back("K" + std::to_string(i + 1));
    }
    std::vector<std::string> lines;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const std::string text = protocols::readIfPossible(entry.path()).value_or("");
        std::string found;
        for (const auto& word : words)
            if (holdsCell(text, word)) found += (found.empty() ? "" : ", ") + word;
        if (!found.empty()) lines.push_back(entry.path().lexically_relative(folder).string() + " names " + found);
    }
    std::ranges::sort(lines);
    return lines;
}

}  // namespace study::leaks
