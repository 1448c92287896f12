// Tables as spreadsheets of other labs write them: any usual separator, decimal commas, any usual encoding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "protocols/files/csv_table.h"

namespace protocols {

/// Largest file of a table that is kept as a whole, bytes. The answers of a large study have 0.2 GB.
inline constexpr std::uint64_t largestTable = std::uint64_t{1} << 29;

struct ForeignTable {
    CsvTable table;       ///< UTF-8, decimal points
    std::string taken;    ///< what the file was taken for: "semicolons, decimal commas, Windows-1252"
    bool isUsual = true;  ///< commas, decimal points and UTF-8: nothing to report
};

/// Reads a table whose form is found in the file: the separator (comma, semicolon, tab or bar) from the header row, or from a
/// first line "sep=;"; decimal commas where the separator is another sign and every number of a column is written so; the
/// encoding by decodedText(), or `encoding` where it is not empty. A cell that safeCell() made safe gets its own text back.
/// Throws badInput as csvTableFrom() and decodedText() do, for a zero byte, for points beside decimal commas and commas beside
/// decimal points that may stand between thousands, and for a file of more than `largestTable` bytes.
ForeignTable readForeignTable(const std::filesystem::path& file, const std::string& encoding = {});
ForeignTable foreignTableFrom(std::string_view bytes, const std::string& where, const std::string& encoding = {});

/// Text of a cell that no spreadsheet takes for a formula: text that begins with =, +, -, @, a tab or a line break gets an
/// apostrophe in front, and so does text that begins with an apostrophe. Numbers and a lone dash stay as they are.
std::string safeCell(std::string_view text);

/// The text that safeCell() was given.
std::string_view cellWithoutGuard(std::string_view cell);

}  // namespace protocols
