// Text of recordings: encoding, lines and cells.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

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
std::vector<std::string_view> splitAt(std::string_view line, char separator);

}  // namespace rendering::fabrics
