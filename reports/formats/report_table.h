// A table with its place on the page.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "reports/formats/table.h"
#include "reports/text/page_section.h"

namespace reports {

/// Larger tables are written to files only: a page with all of them could not be read.
inline constexpr std::size_t mostRowsOnPage = 2000;

struct ReportTable {
    Table table;
    PageSection section = PageSection::Summary;
    std::string question = {};     ///< question of the table; empty: the whole study
    std::string foldedUnder = {};  ///< heading that the reader opens to see the table; empty: always open
    bool onPage = true;            ///< false: the table is written to files only
};

/// Takes the tables of a family one after the other, so that not all of them are held at once.
using TakeTable = std::function<void(ReportTable)>;

}  // namespace reports
