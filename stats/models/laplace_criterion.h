// -2 log likelihood of ordered answers under a cumulative logit model with crossed random intercepts, and its gradient:
//
//     P(answer <= j) = F(threshold_j - eta),  F(x) = 1 / (1 + exp(-x)),  eta = mean of the cell + Z Lambda u.
//
// Laplace's approximation at the mode integrates the random effects out:
//
//     -2 log p(y | u) + u'u + log |Lambda'Z'WZ Lambda + I|.
//
// An answer between the thresholds b < a has the probability
//
//     F(a - eta) - F(b - eta) = F(a - eta) F(eta - b) (1 - exp(b - a)).
//
// So it counts as two choices, "above b" and "not above a", and a factor of the thresholds. Answers of two categories are
// one choice each: the logistic model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stats/models/factor.h"
#include "stats/models/random_columns.h"

namespace stats {

/// Answers, one in each row. Each level of `cells` has a fixed mean, each group a random intercept.
struct OrderedAnswers {
    std::size_t categories = 2;
    std::vector<std::uint32_t> category;  ///< of each answer, 0 to categories - 1; every category occurs
    Factor cells;
    std::vector<Factor> groups;
};

class LaplaceCriterion {
public:
    explicit LaplaceCriterion(const OrderedAnswers& answers);

    /// Number of parameters: standard deviations of the groups, means of the cells, thresholds without the anchor.
    std::size_t parameterCount() const { return m_terms + m_cells + m_thresholds - 1; }
    std::size_t termCount() const { return m_terms; }
    /// The threshold that is 0, next to the median answer: the means are log odds of an answer above it.
    std::size_t anchor() const { return m_anchor; }
    /// Multiplications of one step towards the mode, at most.
    double cost() const { return m_random.cost(); }

    struct At {
        bool exists = false;  ///< false where the mode was not found (extreme parameters, thresholds out of order)
        double value = 0;
        std::vector<double> gradient;
    };
    /// The criterion. The search for the mode begins where the previous one ended.
    At at(std::span<const double> parameters);

    /// Stores the mode of the last at().
    void holdMode(std::span<const double> parameters);
    /// The criterion at a mode that is one Newton step away from the stored one. At the stored parameters it
    /// equals at(), and so does its gradient. Its curvature there gives lme4's standard errors; with the exact mode
    /// they would be larger by 0.1 to 0.2 %.
    At atOneStep(std::span<const double> parameters);

    /// Starting values of means and thresholds: log odds with half an answer of each kind added to every cell, and the log
    /// odds of all answers together.
    std::vector<double> crudeStart() const;
    /// A guess of the variance of each mean and threshold, from the number of answers.
    std::vector<double> crudeVariances() const;

private:
    /// The Newton step that led to a mode: it determines how the mode depends on the parameters.
    struct NewtonStep {
        const BorderedFactor& factor;              ///< factor of Lambda'Z'WZ Lambda + I
        const std::vector<double>& choiceWeights;  ///< one for each choice
        const std::vector<double>& residual;       ///< Z'(y - p), linearised at the mode
    };
    void addAnswer(std::size_t category, std::size_t cell);
    void addChoice(bool isAbove, std::size_t threshold);
    void findPlaces(const std::vector<std::uint32_t>& order);
    /// Parameter of a threshold; the anchor has none.
    std::size_t parameterOf(std::size_t threshold) const
    {
        return m_terms + m_cells + threshold - (threshold > m_anchor ? 1 : 0);
    }
    std::vector<double> thresholdsOf(std::span<const double> parameters) const;
    bool isPossible(std::span<const double> parameters) const;
    double thresholdTerm(std::span<const double> parameters) const;
    double sdOf(std::span<const double> parameters, std::size_t column) const { return parameters[m_random.termOf(column)]; }
    const std::uint32_t* columnsOf(std::size_t answer) const { return m_columns.data() + answer * m_terms; }

    double pass(std::span<const double> parameters, std::span<const double> u);
    bool findMode(std::span<const double> parameters, double& penalised);
    BorderedFactor information(std::span<const double> parameters, std::span<const double> weights) const;
    At finished(std::span<const double> parameters, std::span<const double> u, double penalised, const NewtonStep* step) const;
    std::vector<double> gradient(std::span<const double> parameters, std::span<const double> u,
                                 const std::vector<double>& inverse, const NewtonStep& step) const;
    std::vector<double> addDeterminantGradient(std::span<const double> parameters, const std::vector<double>& inverse,
                                               std::vector<double>& gradient) const;
    void addThresholdGradient(std::span<const double> parameters, std::vector<double>& gradient) const;
    std::vector<double> linearPredictors(std::span<const double> parameters, std::span<const double> u) const;
    std::vector<double> summedByColumn(std::span<const double> rows) const;

    std::size_t m_terms = 0;
    std::size_t m_cells = 0;
    std::size_t m_thresholds = 0;
    std::size_t m_answers = 0;
    std::size_t m_anchor = 0;
    std::vector<std::size_t> m_counts;  ///< answers of each category
    RandomColumns m_random;
    // One element for each answer.
    std::vector<std::uint32_t> m_cellOf;
    std::vector<std::uint32_t> m_columns;      ///< [answers x terms]
    std::vector<std::uint32_t> m_places;       ///< [answers x pairs of terms] places of the products in the matrix
    std::vector<std::uint32_t> m_firstChoice;  ///< its choices, up to the first one of the next answer
    // One element for each choice.
    std::vector<double> m_above;  ///< 1 above the threshold, 0 not
    std::vector<std::uint32_t> m_thresholdOf;
    std::vector<double> m_mode;  ///< u
    // Results of the last pass.
    std::vector<double> m_probability;    ///< of each choice: above the threshold
    std::vector<double> m_choiceWeights;  ///< p (1 - p)
    std::vector<double> m_weights;        ///< the sum of the choices of each answer
    std::vector<double> m_residual;       ///< Z'(y - p)
    // The same at the stored mode.
    std::vector<double> m_heldPredictors;
    std::vector<double> m_heldThresholds;
    std::vector<double> m_heldProbability;
    std::vector<double> m_heldChoiceWeights;
    std::vector<double> m_heldWeights;
};

}  // namespace stats
