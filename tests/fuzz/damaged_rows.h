// Values of a database that a fuzzing run changes one by one, so that its inputs are rows and not pages.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fuzz {

/// JSON that nests more deeply than recursive functions survive.
std::string deepJson();

/// One input for every column of every table, and one for the payload of every entry of the log. It names a table, a column and
/// a row, and holds the value that stands there. Four texts, each ended by the character 0x1F. The first input is followed by
/// one with deepJson() for each of the first values of a column that are JSON. Each column with several rows has another input
/// with two of its later cells. "*" for a row names them all. Then, for each table, inputs in which a row is lost ("-" for a
/// column) or comes twice ("+"; the value is that of the last column of the copy's key).
std::vector<std::string> rowsOf(const std::filesystem::path& database);

/// Inputs with damaged cells that ended commands of earlier versions.
std::vector<std::string> knownDamages();

/// Makes a database by statements of SQL, such as `sqlite3 FILE .dump` prints them.
void makeDatabase(const std::filesystem::path& database, const std::string& sql);

/// Writes the values of an input into the database, with its triggers and checks out of force. An input may name several cells.
/// What SQLite refuses stays as it is; names of no table or column are passed over. Throws std::runtime_error where a column
/// that exists cannot be changed.
void changeRows(const std::filesystem::path& database, const std::string& input);

}  // namespace fuzz
