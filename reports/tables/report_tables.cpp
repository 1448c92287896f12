#include "reports/tables/report_tables.h"

#include <iterator>

#include "reports/tables/choice_tables.h"
#include "reports/tables/claim_tables.h"
#include "reports/tables/effect_tables.h"
#include "reports/tables/false_claim_tables.h"
#include "reports/tables/group_tables.h"
#include "reports/tables/measured_size_tables.h"
#include "reports/tables/omnibus_tables.h"
#include "reports/tables/order_tables.h"
#include "reports/tables/ordinal_tables.h"
#include "reports/tables/overview_tables.h"
#include "reports/tables/pair_tables.h"
#include "reports/tables/plan_tables.h"
#include "reports/tables/quality_tables.h"
#include "reports/tables/rating_tables.h"
#include "reports/tables/signal_tables.h"
#include "reports/tables/speed_tables.h"
#include "reports/tables/worded_tables.h"
#include "reports/text/file_names.h"

namespace reports {
namespace {

using TableFamily = std::vector<ReportTable> (*)(const StudyAnalysis&);

constexpr TableFamily families[] = {overviewTables,   choiceTables,      ratingTables,  wordedTables,  claimTables,
                                    pairTables,       omnibusTables,     ordinalTables, effectTables,  groupTables,
                                    speedTables,      signalTables,      planTables,    qualityTables, orderTables,
                                    falseClaimTables, measuredSizeTables};

}  // namespace

std::vector<ReportTable> reportTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    for (const TableFamily family : families) {
        std::vector<ReportTable> some = family(analysis);
        std::move(some.begin(), some.end(), std::back_inserter(tables));
    }
    // A question called "planned" would get the file name of the planned contrasts.
    FileNames names;
    for (ReportTable& one : tables) {
        one.table.name = names.unique(one.table.name);
        one.onPage = one.onPage && one.table.rows.size() <= mostRowsOnPage;
    }
    return tables;
}

}  // namespace reports
