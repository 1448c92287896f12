// A table with its place on the page.
#pragma once

#include <string>

#include "reports/formats/table.h"
#include "reports/text/page_section.h"

namespace reports {

struct ReportTable {
    Table table;
    PageSection section = PageSection::Summary;
    std::string question = {};     ///< question of the table; empty: the whole study
    std::string foldedUnder = {};  ///< heading that the reader opens to see the table; empty: always open
    bool onPage = true;            ///< false: the table is written to files only
};

}  // namespace reports
