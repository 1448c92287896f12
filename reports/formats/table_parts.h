// A table cut into parts that fit the width of a page: the size of the type, columns in which words are wrapped, and where to
// cut.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/formats/table.h"

namespace reports {

/// Most columns of one part, however narrow they are.
inline constexpr std::size_t mostPartColumns = 14;

/// The place that a table has on its page.
struct TableRoom {
    double widthPt = 0;                             ///< of the text, points
    std::vector<double> scales = {0.9, 0.8, 0.72};  ///< sizes of the type over 10 pt that may be used, falling
    double gapPt = 6;                               ///< between two columns, points: twice \tabcolsep
};

struct PartColumn {
    std::size_t index = 0;  ///< in the table
    double width = 0;       ///< natural width, points at 10 pt
    bool isNumber = false;
    double wrappedPt = 0;  ///< width in which it is wrapped, points; 0: it is not
};

struct TablePart {
    std::vector<PartColumn> columns;
    double scale = 1;  ///< size of the type over 10 pt, one of the room's
};

/// The columns of documents in as few parts as fit the room, of about equal size. Every part begins with the columns of names.
std::vector<TablePart> tableParts(const Table& table, const TableRoom& room);

/// Follows the caption of a part: " (part 1 of 2)". Empty for a table in one part. `number` counts from 1.
std::string partWords(std::size_t number, std::size_t parts);

/// The name of a column in lines no wider than `width` or its longest word, points at 10 pt.
std::vector<std::string> headLines(const std::string& name, double width);

}  // namespace reports
