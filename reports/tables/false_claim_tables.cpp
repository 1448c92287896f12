#include "reports/tables/false_claim_tables.h"

#include <algorithm>
#include <cmath>

#include "reports/data/design_limits.h"
#include "reports/formats/table_cells.h"
#include "stats/power/measured_claims.h"

namespace reports {
namespace {

/// The rates of one test over the nulls of one kind of answer.
struct Rates {
    std::string_view test;
    std::vector<const stats::MeasuredSize*> sizes;

    double mean() const
    {
        double sum = 0;
        for (const auto* size : sizes) sum += size->rate();
        return sum / static_cast<double>(sizes.size());
    }
    const stats::MeasuredSize& highest() const
    {
        return **std::max_element(sizes.begin(), sizes.end(),
                                  [](const auto* a, const auto* b) { return a->rejected < b->rejected; });
    }
};

std::vector<Rates> ratesOf(std::string_view kind)
{
    std::vector<Rates> all;
    for (const stats::MeasuredSize& size : stats::measuredClaims()) {
        if (!size.truth.starts_with(kind)) continue;
        auto place = std::find_if(all.begin(), all.end(), [&](const Rates& rates) { return rates.test == size.test; });
        if (place == all.end()) place = all.insert(all.end(), {size.test, {}});
        place->sizes.push_back(&size);
    }
    return all;
}

Table overallTable()
{
    Table table{"false_claims",
                "False claims in " + std::to_string(stats::measuredStudies) +
                    " simulated studies of the paper's size under each of ten nulls, at the 5 % level",
                {"answers", "claim or test", "mean %", "highest %", "highest under", "remark"},
                {}};
    for (const char* kind : {"ratings", "choices"})
        for (const Rates& rates : ratesOf(kind)) {
            const stats::MeasuredSize& highest = rates.highest();
            table.rows.push_back({textCell(kind), textCell(std::string(rates.test)), numberCell(100 * rates.mean(), 1),
                                  numberCell(100 * highest.rate(), 1),
                                  textCell(std::string(highest.truth.substr(highest.truth.find(", ") + 2))),
                                  textCell(highest.promise == stats::Promise::Shown ? "not used for fabrics like these" : "")});
        }
    return table;
}

TableCell rateCell(const stats::Rejections& rejections) { return numberCell(100 * rejections.rate(), 1); }

Table ownTable(const StudyAnalysis& analysis)
{
    Table table{
        "false_claims_here",
        "A study that varies like this one, without any true difference, claims one falsely in this share of studies. "
        "Interpolated for a study of the paper's size, from the estimated SDs of its interactions with condition (relative "
        "to the residual SD of the simulated ratings)",
        {"question", "SD participants", "SD fabrics", "one contrast %", "any of all pairs %"},
        {}};
    if (!canSpeakForOtherFabrics(analysis.data)) return table;
    for (const FalseClaimFinding& finding : analysis.falseClaims)
        table.rows.push_back({textCell(finding.question), numberCell(finding.participantSd, 2), numberCell(finding.fabricSd, 2),
                              numberCell(100 * finding.one, 1), numberCell(100 * finding.any, 1)});
    return table;
}

/// Empty where nothing was simulated.
Table simulatedTable(const StudyAnalysis& analysis)
{
    Table table{
        "false_claims_simulated",
        "False claims for fabrics like these, simulated afresh: studies of this size, with the same answers missing, the same "
        "contrasts, all estimated SDs, and no true difference",
        {"question", "studies", "first contrast %", "any contrast of the family %", "95 % CI"},
        {}};
    for (const FalseClaimFinding& finding : analysis.falseClaims)
        if (finding.simulated) {
            const stats::Interval interval = finding.simulated->any.interval();
            table.rows.push_back({textCell(finding.question), countCell(finding.simulated->any.studies),
                                  rateCell(finding.simulated->first), rateCell(finding.simulated->any),
                                  intervalCell({100 * *interval.low, 100 * *interval.high}, 1)});
        }
    return table;
}

}  // namespace

std::vector<ReportTable> falseClaimTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    if (Table own = ownTable(analysis); !own.rows.empty())
        tables.push_back({.table = std::move(own), .section = PageSection::Methods});
    if (Table simulated = simulatedTable(analysis); !simulated.rows.empty())
        tables.push_back({.table = std::move(simulated), .section = PageSection::Methods});
    tables.push_back({.table = overallTable(), .section = PageSection::Methods});
    return tables;
}

}  // namespace reports
