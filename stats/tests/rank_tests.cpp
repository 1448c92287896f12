#include "stats/tests/rank_tests.h"

#include <algorithm>

#include "stats/kernels/distributions.h"
#include "stats/kernels/moments.h"
#include "stats/kernels/ranks.h"

namespace stats {
namespace {

std::string tableFault(const BlockTable& table)
{
    if (table.blocks == 0) return "there are no complete blocks";
    if (table.conditions < 2) return "needs at least 2 conditions";
    return nonFiniteFault(table.values, "the table");
}

void refuse(FriedmanTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value : {&test.q, &test.df, &test.p, &test.logP, &test.kendallW, &test.imanDavenportF, &test.fDf1, &test.fDf2,
                         &test.fP, &test.fLogP})
        *value = Value::undefined(why);
}

void refuse(CochranTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value : {&test.q, &test.df, &test.p, &test.logP}) *value = Value::undefined(why);
}

void setImanDavenport(FriedmanTest& test, double k, double n)
{
    const double room = n * (k - 1) - *test.q;
    if (room <= 1e-12 * n * (k - 1) || n < 2) {
        const std::string why = n < 2 ? "needs at least 2 blocks" : "all blocks rank the conditions alike: F has no finite value";
        test.imanDavenportF = test.fDf1 = test.fDf2 = test.fP = test.fLogP = Value::undefined(why);
        return;
    }
    test.imanDavenportF = (n - 1) * *test.q / room;
    test.fDf1 = k - 1;
    test.fDf2 = (k - 1) * (n - 1);
    const TailProbability tail = fisherUpper(*test.imanDavenportF, *test.fDf1, *test.fDf2);
    test.fP = tail.p;
    test.fLogP = tail.logP;
}

}  // namespace

BlockTableResult blockTableOf(const std::vector<std::vector<double>>& rows)
{
    BlockTableResult result;
    result.table.blocks = rows.size();
    result.table.conditions = rows.empty() ? 0 : rows.front().size();
    for (const auto& row : rows) {
        if (row.size() != result.table.conditions) {
            result.fault = "rows differ in length";
            return result;
        }
        result.table.values.insert(result.table.values.end(), row.begin(), row.end());
    }
    return result;
}

FriedmanTest friedmanTest(const BlockTable& table)
{
    FriedmanTest test;
    test.blocks = table.blocks;
    if (const std::string fault = tableFault(table); !fault.empty()) {
        refuse(test, fault);
        return test;
    }
    const auto k = static_cast<double>(table.conditions);
    const auto n = static_cast<double>(table.blocks);
    // All sums are whole numbers: doubled ranks, and t^3 - t of a group of t ties.
    std::vector<long long> sums(table.conditions, 0);
    double tied = 0;
    for (std::size_t block = 0; block < table.blocks; ++block) {
        const MidRanks ranks = midRanks<double>(withoutRounding(table.row(block)));
        for (std::size_t condition = 0; condition < table.conditions; ++condition) sums[condition] += ranks.doubled[condition];
        for (const std::size_t size : ranks.ties) {
            const auto t = static_cast<double>(size);
            tied += t * t * t - t;
        }
    }
    double squares = 0;
    const long long expected = static_cast<long long>(table.blocks) * static_cast<long long>(table.conditions + 1);
    for (const long long sum : sums) squares += static_cast<double>(sum - expected) * static_cast<double>(sum - expected) / 4;
    const double spread = n * k * (k + 1) - tied / (k - 1);
    if (!(spread > 0)) {
        refuse(test, "every block rates all conditions alike");
        return test;
    }
    test.q = 12 * squares / spread;
    test.df = k - 1;
    const TailProbability tail = chiSquaredUpper(*test.q, *test.df);
    test.p = tail.p;
    test.logP = tail.logP;
    test.kendallW = std::min(1.0, *test.q / (n * (k - 1)));
    setImanDavenport(test, k, n);
    return test;
}

CochranTest cochranTest(const BlockTable& table)
{
    CochranTest test;
    test.blocks = table.blocks;
    std::string fault = tableFault(table);
    if (fault.empty() && std::any_of(table.values.begin(), table.values.end(), [](double x) { return x != 0 && x != 1; }))
        fault = "needs successes coded as 0 and 1";
    if (!fault.empty()) {
        refuse(test, fault);
        return test;
    }
    const auto k = static_cast<double>(table.conditions);
    double total = 0;
    double rowTerm = 0;
    double columnSquares = 0;
    for (std::size_t block = 0; block < table.blocks; ++block) {
        double successes = 0;
        for (const double x : table.row(block)) successes += x;
        total += successes;
        rowTerm += successes * (k - successes);
    }
    for (std::size_t condition = 0; condition < table.conditions; ++condition) {
        double successes = 0;
        for (const double x : table.column(condition)) successes += x;
        columnSquares += successes * successes;
    }
    if (rowTerm == 0) {
        refuse(test, "no block has both successes and failures");
        return test;
    }
    test.q = (k - 1) * (k * columnSquares - total * total) / rowTerm;
    test.df = k - 1;
    const TailProbability tail = chiSquaredUpper(*test.q, *test.df);
    test.p = tail.p;
    test.logP = tail.logP;
    return test;
}

}  // namespace stats
