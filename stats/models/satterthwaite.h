// Tests of the fixed effects of a fitted linear mixed model, with Satterthwaite's degrees of freedom
// (Kuznetsova et al. 2017, J. Stat. Softw. 82(13)).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "stats/kernels/value.h"

namespace stats {

struct MixedModel;
class StudentQuantiles;

/// A weighted sum of the fixed effects against 0.
struct ContrastTest {
    Value estimate;
    Value se;
    Value df;  ///< Satterthwaite's
    Value t;
    Value p;  ///< two-sided
    Value logP;
    Interval ci;
};

struct FTest {
    std::string why;  ///< empty when the test exists
    Value f;
    Value df1;
    Value df2;
    Value p;
    Value logP;
};

/// Test of a contrast; one weight for each fixed effect, in their order.
ContrastTest contrastTest(const MixedModel& model, std::span<const double> weights, double confidence = 0.95);

/// Test of level a - level b of a treatment-coded factor that is the only fixed effect; level 0 is the reference.
ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence = 0.95);

/// The same for one of many pairs, in constant time.
ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence,
                             StudentQuantiles& quantiles);

/// F test of all fixed effects except the intercept together: the test of condition. F does not depend on the
/// contrasts that express the hypothesis. Its denominator degrees of freedom (from the eigenvectors of their
/// covariance, Fai and Cornelius 1996) do where cells are missing; as in lmerTest, the contrasts are sequential.
FTest effectTest(const MixedModel& model);

}  // namespace stats
