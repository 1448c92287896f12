// A table with its place on the page.
#pragma once

#include <string>

#include "reports/tables/table.h"
#include "reports/text/page_section.h"

namespace reports {

struct ReportTable {
    Table table;
    PageSection section = PageSection::Summary;
    std::string question = {};     ///< whose table it is; empty: the whole study's
    std::string foldedUnder = {};  ///< heading of the fold that a reader opens to see it; empty: always open
    bool onPage = true;            ///< false: the table is written to files only
};

}  // namespace reports
