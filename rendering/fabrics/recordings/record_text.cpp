#include "rendering/fabrics/recordings/record_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"

namespace rendering::fabrics {

namespace {

constexpr std::size_t mostRecordTables = 10'000;  ///< of one file

/// Removes the characters that a JSON string may not contain, so that only its encoding is tested.
std::string quotable(std::string text)
{
    std::erase_if(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\'; });
    return text;
}

/// Each line takes 16 bytes as a part of the text, and so does each cell.
void requireFewParts(std::string_view text, const std::string& where)
{
    std::size_t line = 1, tabs = 0, commas = 0;
    for (const char c : text) {
        if (c == '\n') tabs = commas = 0, ++line;
        tabs += c == '\t';
        commas += c == ',';
        if (tabs < protocols::mostColumns && commas < protocols::mostColumns && line <= mostRecordLines) continue;
        const bool isLong = line > mostRecordLines;
        const std::size_t most = isLong ? mostRecordLines : protocols::mostColumns;
        throw protocols::badInput({"has more than " + std::to_string(most) + (isLong ? " lines" : " cells in a line"),
                                   isLong ? where : where + ", line " + std::to_string(line), "at most " + std::to_string(most),
                                   isLong ? "split the recording" : "check that the file is a recording"});
    }
}

}  // namespace

std::string recordText(const std::filesystem::path& file)
{
    const std::string bytes = protocols::readWholeFile(file, protocols::largestTable);
    requireFewParts(bytes, file.string());
    const std::string_view unmarked = protocols::withoutByteOrderMark(bytes);
    if (unmarked.size() == bytes.size()) return asUtf8(bytes);
    std::string text = readable(std::string(unmarked));
    std::erase(text, '\r');
    return text;
}

std::string asUtf8(std::string_view latin1)
{
    std::string text;
    text.reserve(latin1.size());
    for (const char c : latin1) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80) {
            text += char(0xC0 | (byte >> 6));
            text += char(0x80 | (byte & 0x3F));
        } else if (c != '\r') {
            text += c;
        }
    }
    return text;
}

std::string readable(const std::string& text)
{
    // nlohmann's decoder recognises every malformed sequence, so a second decoder is not needed.
    return nlohmann::json::accept("\"" + quotable(text) + "\"") ? text : asUtf8(text);
}

std::vector<std::string_view> linesOf(std::string_view text)
{
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

LineCells splitAt(std::string_view line, char separator)
{
    LineCells cells;
    while (true) {
        const auto at = line.find(separator);
        cells.push_back(line.substr(0, at));
        if (at == std::string_view::npos) return cells;
        line.remove_prefix(at + 1);
    }
}

std::optional<double> numberOf(std::string_view cell, bool decimalComma)
{
    if (!decimalComma) return protocols::numberIn(cell);
    std::string text(cell);
    std::replace(text.begin(), text.end(), ',', '.');
    return protocols::numberIn(text);
}

std::string lineName(const std::string& where, std::size_t line) { return where + ", line " + std::to_string(line + 1); }

void requireFewTables(std::size_t count, const std::string& where)
{
    if (count <= mostRecordTables) return;
    throw protocols::badInput({"has more than " + std::to_string(mostRecordTables) + " tables", where,
                               "at most " + std::to_string(mostRecordTables), "check that the file is a recording, or split it"});
}

protocols::Error rowOutsideTable(const std::string& where, std::size_t line)
{
    return protocols::badInput({"a row of numbers stands after the end of its table", lineName(where, line),
                                "rows of numbers directly below their header or below each other",
                                "remove the lines that interrupt the table, or the row"});
}

}  // namespace rendering::fabrics
