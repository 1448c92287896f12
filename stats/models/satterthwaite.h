// Tests of the fixed effects of a fitted linear mixed model, with Satterthwaite's degrees of freedom
// (Kuznetsova et al. 2017, J. Stat. Softw. 82(13)).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "stats/kernels/value.h"

namespace stats {

struct MixedModel;

/// A weighted sum of the fixed effects against 0.
struct ContrastTest {
    Value estimate;
    Value se;
    Value df;  ///< Satterthwaite
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

/// Weights: one a fixed effect, in their order.
ContrastTest contrastTest(const MixedModel& model, std::span<const double> weights, double confidence = 0.95);

/// Difference of two levels of a treatment-coded factor that is the only fixed effect: level a - level b,
/// level 0 being the reference.
ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence = 0.95);

/// All the fixed effects but the first (the intercept) against 0 together: the F test of condition. F
/// itself does not depend on how the hypothesis is written as contrasts; its denominator degrees of
/// freedom (from the eigenvectors of their covariance, Fai and Cornelius 1996) do where cells are missing.
/// As in lmerTest they are the sequential contrasts.
FTest effectTest(const MixedModel& model);

}  // namespace stats
