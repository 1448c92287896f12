// Intraclass correlations (Shrout and Fleiss 1979): how far measurements of the same target agree, from
// complete tables of targets by raters. The first number names the model (1: every target has its own
// raters; 2: raters are a sample; 3: these raters), k the mean of all raters instead of one.
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

/// Rows are targets, columns raters; at least 2 of each.
IntraclassCorrelations intraclassCorrelations(const BlockTable& targetsByRaters);

struct MeanSquares {
    double targets = 0;
    double raters = 0;
    double error = 0;
};

/// From the mean squares of n targets by k raters.
IntraclassCorrelations intraclassCorrelations(const MeanSquares& ms, double targets, double raters);

}  // namespace stats
