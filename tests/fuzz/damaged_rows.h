// Values of a database that a fuzzing run changes one by one, so that its inputs are rows and not pages.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fuzz {

/// One input for every column of every table, and one for the payload of every entry of the log. It names a table, a column and
/// a row, and holds the value that stands there. Four texts, each ended by the character 0x1F.
std::vector<std::string> rowsOf(const std::filesystem::path& database);

/// Writes the values of an input into the database, with its triggers and checks out of force. An input may name several cells.
/// What SQLite refuses stays as it is.
void changeRows(const std::filesystem::path& database, const std::string& input);

}  // namespace fuzz
