// Minimises the criterion of a linear mixed model over theta: Newton's method with exact second derivatives; every
// step must lower the criterion. Deterministic. Random terms whose variance is zero are left out: their estimate is exactly zero.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stats/models/mixed_model_balanced.h"
#include "stats/models/mixed_model_criterion.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {

/// Lower bound of a relative standard deviation; an estimate at the bound counts as zero.
inline constexpr double thetaFloor = 1e-4;
/// A mean square (a quadratic form) equals its expectation within this share: a variance of zero is neither positive nor
/// negative.
inline constexpr double tieShare = 1e-5;
/// What a fit leaves of the criterion, beside rounding: a variance that lowers it by less is zero.
inline constexpr double criterionNoise = 2e-9;
/// Beyond this relative standard deviation no residual variation is left, which is the reason of a refusal.
inline constexpr double largestTheta = 1e5;
inline constexpr const char* noResidual = "the random effects reproduce every value: no residual variation is left";

struct ThetaFit {
    std::string why;  ///< empty when a minimum was found
    CriterionParts parts;
    SystemSolution solution;
    std::vector<bool> free;  ///< for each theta: not at the lower bound
    int steps = 0;
};

ThetaFit fitTheta(const MixedModelSystem& system, bool reml);

/// What a variance at zero does to Satterthwaite's degrees of freedom where the criterion is level there, so that nothing speaks
/// for a negative variance either.
enum class Ties {
    LeftOut,  ///< as lmerTest does
    Counted,  ///< it stays a parameter. Values that are all equal under a condition make such ties; left out, the same answers
              ///< would count twice
};

/// The equations of a model, or the reason why it takes too long.
struct ChosenSystem {
    std::string why;
    std::unique_ptr<MixedModelSystem> system;
};

/// A fit with some of the random terms.
struct FittedTerms {
    std::vector<std::size_t> kept;  ///< ascending; the terms of `system`, in this order
    std::vector<std::size_t> tied;  ///< Ties::Counted: terms at zero where a quadratic form equals its expectation
    std::unique_ptr<MixedModelSystem> system;
    ThetaFit fit;
};

/// The models with any of the random terms of these rows, which outlive it.
class TermChoice {
public:
    TermChoice(const MixedModelRows& rows, bool reml, Ties ties)
        : m_rows(rows), m_balanced(balancedDesign(rows)), m_reml(reml), m_ties(ties)
    {
    }

    ChosenSystem systemOf(const std::vector<std::size_t>& terms) const;
    /// Fits all terms; leaves out the intercepts whose variance is zero, and fits again without them.
    FittedTerms fitWithoutZeros() const;
    bool reml() const { return m_reml; }

private:
    FittedTerms fit(std::vector<std::size_t> terms) const;
    bool isTie(const TermPlace& term, const FittedTerms& fitted) const;
    bool leaveOutZeros(FittedTerms& fitted) const;
    bool leaveOutLevel(FittedTerms& fitted) const;

    const MixedModelRows& m_rows;
    std::optional<BalancedDesign> m_balanced;
    bool m_reml;
    Ties m_ties;
};

}  // namespace stats
