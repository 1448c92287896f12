// Intraclass correlations (Shrout and Fleiss 1979): agreement of the raters of the same targets, from complete
// tables of targets by raters. The number names the model (1: every target has its own raters; 2: raters are a
// sample; 3: these raters only); k means the mean of all raters instead of a single rater.
#pragma once

#include "stats/kernels/block_table.h"
#include "stats/kernels/value.h"

namespace stats {

struct IntraclassCorrelations {
    std::string why;  ///< empty when they exist
    Value icc1;
    Value icc2;
    Value icc3;
    Value icc1k;
    Value icc2k;
    Value icc3k;  ///< equals Cronbach's alpha
};

/// Correlations of a table whose rows are targets and whose columns are raters, at least 2 of each.
IntraclassCorrelations intraclassCorrelations(const BlockTable& targetsByRaters);

struct MeanSquares {
    double targets = 0;
    double raters = 0;
    double error = 0;
};

/// Correlations from the mean squares of an analysis of variance.
IntraclassCorrelations intraclassCorrelations(const MeanSquares& ms, double targets, double raters);

/// Confidence intervals of the correlations of models 2 and 3 (Shrout and Fleiss 1979; McGraw and Wong 1996).
struct IntraclassIntervals {
    std::string why;  ///< empty when they exist
    Interval icc2;
    Interval icc3;
    Interval icc2k;
    Interval icc3k;
};

/// Intervals of the same table. Refused with a reason where the correlations are, and for raters who differ by constants only,
/// because the intervals then have no width.
IntraclassIntervals intraclassIntervals(const BlockTable& targetsByRaters, double confidence = 0.95);

}  // namespace stats
