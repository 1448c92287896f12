// One-way repeated-measures analysis of variance on complete blocks, with the Greenhouse-Geisser and Huynh-Feldt
// corrections, Mauchly's test, within-subject intervals and intraclass correlations.
#pragma once

#include "stats/kernels/block_table.h"
#include "stats/tests/sphericity.h"

namespace stats {

struct RepeatedMeasuresAnova {
    std::string why;  ///< empty when F exists
    std::size_t blocks = 0;
    Value ssCondition;
    Value ssSubject;
    Value ssError;
    Value f;
    Value df1;
    Value df2;
    Value p;  ///< assumes sphericity
    Value logP;
    Value epsilonGg;  ///< Greenhouse and Geisser 1959, from the double-centred covariance
    Value pGg;
    Value logPGg;
    MauchlyTest mauchly;
    Value epsilonHf;  ///< Huynh and Feldt 1976; where it exceeds 1 the test uses 1
    Value pHf;
    Value logPHf;
    Value partialEtaSquared;
    Value generalizedEtaSquared;
    std::vector<Value> moreyHalfWidths;  ///< one for each condition
    Value icc2;                          ///< ICC(2,1): conditions as targets, blocks as raters (Shrout and Fleiss 1979)
    Value icc2k;
    Value icc3;
    Value icc3k;
};

RepeatedMeasuresAnova repeatedMeasuresAnova(const BlockTable& table);

/// Half-widths of within-subject intervals (Morey 2008), one for each condition: t quantile x SD of the normalised
/// values / sqrt(n) x sqrt(k / (k - 1)). Normalised values have the differences between blocks removed.
std::vector<Value> moreyHalfWidths(const BlockTable& table, double confidence = 0.95);

}  // namespace stats
