// A table cut into parts that fit the width of a page: the size of the type, columns in which words are wrapped, and where to
// cut.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/formats/table.h"

namespace reports {

/// Most columns of one part.
inline constexpr std::size_t mostPartColumns = 8;

struct PartColumn {
    std::size_t index = 0;  ///< in the table
    double width = 0;       ///< natural width, points at 10 pt
    bool isNumber = false;
    double wrappedPt = 0;  ///< width in which it is wrapped, points; 0: it is not
};

struct TablePart {
    std::vector<PartColumn> columns;
    double scale = 1;  ///< size of the type over 10 pt: 0.9, 0.8 or 0.72
};

/// The columns of documents in as few parts as fit `widthPt`. Every part begins with the columns of names.
std::vector<TablePart> tableParts(const Table& table, double widthPt);

/// The name of a column in lines no wider than `width` or its longest word, points at 10 pt.
std::vector<std::string> headLines(const std::string& name, double width);

}  // namespace reports
