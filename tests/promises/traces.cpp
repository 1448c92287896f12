#include "tests/promises/traces.h"

#include <algorithm>
#include <cctype>

#include "protocols/files/byte_search.h"
#include "protocols/files/whole_file.h"
#include "tests/support/raw_sqlite.h"

namespace tests::promises {

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

constexpr std::size_t saltDigits = 64;

/// The values of a column that the rows of nobody else have.
Texts onlyOf(const std::string& participant, support::RawSqlite& sqlite, const std::string& column, const std::string& table)
{
    const std::string select = "SELECT " + column + " FROM " + table + " WHERE " + column + " IS NOT NULL AND participant ";
    return sqlite.rows(select + "= '" + participant + "' EXCEPT " + select + "<> '" + participant + "'");
}

/// As SQLite keeps a number of more than 47 bits: 8 bytes, the highest first.
std::string asStored(const std::string& number)
{
    std::string bytes;
    const auto value = static_cast<unsigned long long>(std::stoll(number));
    for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
}

}  // namespace

Traces tracesOf(const std::string& participant, const database::StudyFolder& folder)
{
    struct Source {
        const char *kind, *column, *table;
    };
    constexpr Source sources[] = {{"salts", "salt", "events"},
                                  {"salts", "salt", "participant_facts"},
                                  {"facts", "value", "participant_facts"},
                                  {"notes", "text", "notes"},
                                  {"samples of the finger", "substr(samples, 1, 24)", "finger_samples"},
                                  {"times", "wall_time", "events"},
                                  {"stored times", "at_ns", "events"},
                                  {"stored times", "began_at", "finger_samples"},
                                  {"stored times", "ready_at", "responses"},
                                  {"stored times", "touched_at", "responses"},
                                  {"stored times", "answered_at", "responses"},
                                  {"stored times", "stored_at", "responses"}};
    support::RawSqlite sqlite(folder.database());
    Traces traces;
    for (const Source& source : sources)
        for (const std::string& text : onlyOf(participant, sqlite, source.column, source.table)) {
            const bool isNumber = source.kind == std::string("stored times");
            if (isNumber) traces["times"].push_back(text);
            traces[source.kind].push_back(isNumber ? asStored(text) : text);
        }
    return traces;
}

std::set<std::string> kindsFoundIn(const std::vector<fs::path>& folders, const Traces& traces)
{
    std::set<std::string> kinds;
    for (const auto& [kind, sequences] : traces)
        if (filesWith({{kind, sequences}}, folders) > 0) kinds.insert(kind);
    return kinds;
}

int filesWith(const Traces& traces, const std::vector<fs::path>& folders)
{
    Texts all;
    for (const auto& [kind, sequences] : traces) all.insert(all.end(), sequences.begin(), sequences.end());
    int found = 0;
    for (const fs::path& folder : folders) found += static_cast<int>(protocols::searchFiles(folder, all).found.size());
    return found;
}

std::set<std::string> possibleSaltsIn(const fs::path& folder)
{
    std::set<std::string> texts;
    for (const auto& file : fs::recursive_directory_iterator(folder)) {
        if (!file.is_regular_file()) continue;
        const std::string bytes = protocols::readWholeFile(file.path());
        const auto isDigit = [](unsigned char c) { return std::isxdigit(c) != 0; };
        for (auto begin = bytes.begin(); begin != bytes.end();) {
            begin = std::find_if(begin, bytes.end(), isDigit);
            const auto end = std::find_if_not(begin, bytes.end(), isDigit);
            // Columns of a database follow each other without a gap.
            for (auto from = begin; end - from >= static_cast<long>(saltDigits); from += saltDigits)
                texts.insert(std::string(from, from + saltDigits));
            begin = end;
        }
    }
    return texts;
}

}  // namespace tests::promises
