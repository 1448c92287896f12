#include "reports/tables/report_tables.h"

#include <span>
#include <utility>

#include "reports/tables/chain_tables.h"
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
#include "reports/tables/touch_tables.h"
#include "reports/tables/worded_tables.h"
#include "reports/text/file_names.h"

namespace reports {
namespace {

/// A family whose tables are small enough to be made together.
template <std::vector<ReportTable> (*tablesOf)(const StudyAnalysis&)>
void together(const StudyAnalysis& analysis, const TakeTable& take)
{
    for (ReportTable& one : tablesOf(analysis)) take(std::move(one));
}

using TableFamily = void (*)(const StudyAnalysis&, const TakeTable&);

constexpr TableFamily families[] = {together<overviewTables>,
                                    together<choiceTables>,
                                    together<ratingTables>,
                                    together<wordedTables>,
                                    claimTables,
                                    pairTables,
                                    together<omnibusTables>,
                                    together<ordinalTables>,
                                    together<effectTables>,
                                    together<groupTables>,
                                    together<speedTables>,
                                    together<chainTables>,
                                    together<touchTables>,
                                    together<signalTables>,
                                    together<planTables>,
                                    together<qualityTables>,
                                    together<orderTables>,
                                    together<falseClaimTables>,
                                    together<measuredSizeTables>};

constexpr TableFamily blindedFamilies[] = {together<overviewTables>, together<planTables>, together<qualityTables>};

std::span<const TableFamily> familiesOf(const StudyAnalysis& analysis)
{
    if (analysis.data.blinded) return blindedFamilies;
    return families;
}

}  // namespace

void forEachTable(const StudyAnalysis& analysis, const TakeTable& take)
{
    // A question called "planned" would get the file name of the planned contrasts.
    FileNames names;
    for (const TableFamily family : familiesOf(analysis))
        family(analysis, [&](ReportTable one) {
            one.table.name = names.unique(one.table.name);
            one.onPage = one.onPage && one.table.rows.size() <= mostRowsOnPage;
            take(std::move(one));
        });
}

std::vector<ReportTable> reportTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    forEachTable(analysis, [&](ReportTable one) { tables.push_back(std::move(one)); });
    return tables;
}

}  // namespace reports
