// Student's and Welch's t tests with interval, effect sizes and the logarithm of p.
//
// A test that does not exist (too few values, no variation, a value that is not finite) has its reason in `why`;
// its t and p are then undefined. A sample counts as constant up to the rounding of its inputs: 1.1-1.0, 2.1-2.0
// and 3.1-3.0 are the same difference, although their doubles differ.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "stats/kernels/value.h"

namespace stats {

enum class Tail { TwoSided, Less, Greater };  ///< Less: the first mean (or difference) lies below
enum class TKind { OneSample, Paired, Student, Welch };

struct TOptions {
    double mu = 0;  ///< tested mean, or tested difference of means
    Tail tail = Tail::TwoSided;
    double confidence = 0.95;
};

struct TTest {
    std::string why;          ///< empty when the test exists
    std::size_t n = 0;        ///< number of values, of pairs, or of values in the first sample
    std::size_t nSecond = 0;  ///< number of values in the second sample (Student, Welch)
    Value estimate;           ///< mean, mean difference x - y, or difference of means
    Value sd;                 ///< SD of the sample or of the differences; pooled (Student)
    Value se;
    Value t;
    Value df;
    Value p;          ///< 0 only where it is below the smallest double: see logP
    Value logP;       ///< natural logarithm
    Interval ci;      ///< confidence interval of the estimate; one end is open for a one-sided tail
    Value dZ;         ///< (mean difference - mu) / sd of differences; one sample: (mean - mu) / sd
    Value hedgesGz;   ///< dZ times Hedges' exact correction
    Value dAvLakens;  ///< mean difference / mean of the two SDs (Lakens 2013)
    Value dAvRms;     ///< mean difference / root mean square of the two SDs
    Value dS;         ///< difference / pooled SD (Student)
    Value hedgesGs;

    Value log10P() const;
};

TTest oneSampleTTest(std::span<const double> x, const TOptions& options = {});
TTest pairedTTest(std::span<const double> x, std::span<const double> y, const TOptions& options = {});
TTest studentTTest(std::span<const double> x, std::span<const double> y, const TOptions& options = {});
TTest welchTTest(std::span<const double> x, std::span<const double> y, const TOptions& options = {});

/// The test named by `kind`; the one-sample test ignores y.
TTest tTest(TKind kind, std::span<const double> x, std::span<const double> y, const TOptions& options = {});

}  // namespace stats
