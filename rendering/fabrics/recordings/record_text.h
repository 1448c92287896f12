// Text of recordings: encoding, lines and cells.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/files/errors.h"

namespace rendering::fabrics {

/// Most lines of a recording: 2.8 hours at 1 kHz.
inline constexpr std::size_t mostRecordLines = 10'000'000;

/// The text of a recording in UTF-8, without carriage returns. Text without a byte order mark counts as Latin-1. Throws badInput
/// as readWholeFile() does. Throws it, too, for more than `protocols::largestTable` bytes, more than `mostRecordLines` lines, and
/// more than `protocols::mostColumns` cells in a line, whether tabs or commas separate them.
std::string recordText(const std::filesystem::path& file);
/// Converts Latin-1 to UTF-8 and removes carriage returns.
std::string asUtf8(std::string_view latin1);
/// Returns UTF-8 unchanged and converts other bytes from Latin-1. For names in messages, pictures and JSON.
std::string readable(const std::string& text);
/// Lines of a text; the text must outlive them.
std::vector<std::string_view> linesOf(std::string_view text);
using LineCells = std::vector<std::string_view>;
LineCells splitAt(std::string_view line, char separator);

inline constexpr std::size_t longestCellShown = 60;  ///< in a message, bytes

/// The number in a cell; none where it holds anything else.
std::optional<double> numberOf(std::string_view cell, bool decimalComma);

/// "FILE, line 3" for the line with the index 2.
std::string lineName(const std::string& where, std::size_t line);

/// Throws badInput for more tables than a recording may have. A table without rows takes some hundred bytes.
void requireFewTables(std::size_t count, const std::string& where);

/// badInput for a row of numbers that stands in no table.
protocols::Error rowOutsideTable(const std::string& where, std::size_t line);

}  // namespace rendering::fabrics
