#include "reports/tables/false_claim_tables.h"

#include <algorithm>
#include <cmath>

#include "reports/tables/table_cells.h"
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
                {"answers", "claim", "mean %", "highest %", "highest under"},
                {}};
    for (const char* kind : {"ratings", "choices"})
        for (const Rates& rates : ratesOf(kind)) {
            const stats::MeasuredSize& highest = rates.highest();
            table.rows.push_back({textCell(kind), textCell(std::string(rates.test)), numberCell(100 * rates.mean(), 1),
                                  numberCell(100 * highest.rate(), 1),
                                  textCell(std::string(highest.truth.substr(highest.truth.find(", ") + 2)))});
        }
    return table;
}

/// SD of a random effect, 0 where the effect was left out.
double sdOf(const stats::RatingModel& fitted, const std::string& effect, double unit)
{
    for (const stats::RandomEffect& one : fitted.model.random)
        if (one.name == effect && one.sd.exists()) return *one.sd / unit;
    return 0;
}

double sdOf(const stats::ChoiceModel& fitted, const std::string& effect)
{
    for (const stats::RandomIntercept& one : fitted.model.random)
        if (one.name == effect && one.sd.exists()) return *one.sd;
    return 0;
}

void addQuestion(Table& table, const std::string& id, const stats::ClaimNull& null)
{
    table.rows.push_back({textCell(id), numberCell(null.participantSd, 2), numberCell(null.fabricSd, 2),
                          numberCell(100 * stats::falseClaimRate(stats::contrastOfFabricsLikeThese, null), 1),
                          numberCell(100 * stats::falseClaimRate(stats::anyContrastOfFabricsLikeThese, null), 1)});
}

Table ownTable(const StudyAnalysis& analysis)
{
    Table table{
        "false_claims_here",
        "A study like this one, without any true difference, claims one falsely in this share of studies: interpolated for "
        "the estimated SDs of its interactions with condition",
        {"question", "SD participants", "SD fabrics", "one contrast %", "any of all pairs %"},
        {}};
    const std::string people = "participant:condition", fabrics = "fabric:condition";
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis))
        if (const stats::ChoiceModel& model = question.findings.crossedModel; model.model.why.empty())
            addQuestion(table, question.id(), {true, sdOf(model, people), sdOf(model, fabrics), false});
    for (const auto& question : questionsWith<RatingAnalysis>(analysis))
        if (const stats::RatingModel& model = question.findings.model; model.model.why.empty()) {
            // The nulls were drawn on a scale of ten points.
            const double unit = (question.findings.scale.max - question.findings.scale.min) / 10;
            addQuestion(table, question.id(), {false, sdOf(model, people, unit), sdOf(model, fabrics, unit), false});
        }
    return table;
}

}  // namespace

std::vector<ReportTable> falseClaimTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    if (Table own = ownTable(analysis); !own.rows.empty())
        tables.push_back({.table = std::move(own), .section = PageSection::Methods});
    tables.push_back({.table = overallTable(), .section = PageSection::Methods});
    return tables;
}

}  // namespace reports
