// Tables as an attacker reads them: every table and view of a SQLite file, and every file of a folder, all cells as text. It uses
// no other knowledge of the study.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace study::leaks {

struct TextTable {
    std::string name;  ///< of the table, or the file's path in its folder
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`; NULL is empty

    std::optional<std::size_t> column(const std::string& name) const;
};

/// The tables and views of the file. Tables with row numbers have them in a first column "rowid". Throws as SqliteConnection
/// does, and workFailed for a view that this program does not make: it may never end.
std::vector<TextTable> tablesOfDatabase(const std::filesystem::path& file);

/// The files below the folder. A CSV file gives a table, and so does each array of objects in a JSON file, with the plain fields
/// of the objects around it. Any other file, and one with more than 400 columns or 30 million cells, gives the lines that hold
/// one of `words`. `left`: paths in the folder that are not read.
std::vector<TextTable> tablesOfFolder(const std::filesystem::path& folder, const std::set<std::string>& words,
                                      const std::set<std::filesystem::path>& left = {});

}  // namespace study::leaks
