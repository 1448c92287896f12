// A column of numbers described, and two columns compared, as the JSON that `vis2hap describe` and `compare` print. A number
// that does not exist is null, with its reason in "why".
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <utility>
#include <vector>

#include "stats/tests/t_tests.h"

namespace study::analyse {

/// Schema vis2hap.describe/1. Missing values are NaN.
nlohmann::ordered_json describeColumn(const std::vector<double>& values);

enum class ColumnTest { Paired, Welch, Student, Equivalence, Wilcoxon };

struct ColumnComparison {
    ColumnTest test = ColumnTest::Paired;
    stats::Tail tail = stats::Tail::TwoSided;     ///< tail of a - b; equivalence tests have none
    std::pair<double, double> bounds{-0.5, 0.5};  ///< for equivalence
};

/// Schema vis2hap.compare/1: a - b. Pairs without both values are counted as missing, and left out.
nlohmann::ordered_json compareColumns(const ColumnComparison& comparison, const std::vector<double>& a,
                                      const std::vector<double>& b);

}  // namespace study::analyse
