// -2 log likelihood of a logistic model with crossed random intercepts, the random effects integrated
// out by Laplace's approximation at their mode, with its gradient:
//
//     -2 log p(y | u) + u'u + log |Lambda'Z'WZ Lambda + I|,  eta = mean of the cell + Z Lambda u.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/models/factor.h"

namespace stats {

class LaplaceCriterion {
public:
    /// `right`: 0 or 1 a row. One fixed mean (log odds) a level of `cells`; one random term a group.
    LaplaceCriterion(std::span<const double> right, const Factor& cells, std::span<const Factor> groups);

    /// Standard deviations of the terms, then the means of the cells.
    std::size_t parameterCount() const { return m_terms + m_cells; }
    std::size_t termCount() const { return m_terms; }

    struct At {
        bool exists = false;  ///< false: the mode was not found (parameters far out)
        double value = 0;
        std::vector<double> gradient;
    };
    /// Begins the search for the mode where the last one ended.
    At at(std::span<const double> parameters);

    /// Holds the mode of the last at().
    void holdMode(std::span<const double> parameters);
    /// The criterion where the mode follows the parameters by one Newton step from the one held. Equal to
    /// at() with its gradient where it was held; its curvature there is what lme4 takes standard errors
    /// from (a mode that moves all the way makes them larger by 0.1 to 0.2 %).
    At atOneStep(std::span<const double> parameters);

    /// Log odds with half an answer of each kind added to every cell: where a fit may begin.
    std::vector<double> crudeMeans() const;

private:
    /// The Newton step that led to a mode: how the mode answers to the parameters.
    struct NewtonStep {
        Matrix inverse;                ///< of Lambda'Z'WZ Lambda + I
        std::vector<double> weights;   ///< by row
        std::vector<double> residual;  ///< Z'(y - p), linearised at the mode
    };
    double pass(std::span<const double> parameters, std::span<const double> u);
    bool findMode(std::span<const double> parameters, double& penalised);
    Matrix information(std::span<const double> parameters) const;
    At finished(std::span<const double> parameters, std::span<const double> u, double penalised, const NewtonStep* step) const;
    std::vector<double> gradient(std::span<const double> parameters, std::span<const double> u, const Matrix& inverse,
                                 const NewtonStep& step) const;
    std::vector<double> logOdds(std::span<const double> parameters, std::span<const double> u) const;
    double sdOf(std::span<const double> parameters, std::size_t column) const { return parameters[m_termOf[column]]; }

    std::size_t m_rows = 0;
    std::size_t m_terms = 0;
    std::size_t m_cells = 0;
    std::vector<double> m_right;
    std::vector<std::uint32_t> m_cellOf;
    std::vector<std::uint32_t> m_columns;  ///< [rows x terms] random column of each row and term
    std::vector<std::uint32_t> m_termOf;   ///< of each random column
    std::vector<double> m_mode;            ///< u
    // Of the last pass.
    std::vector<double> m_probability;
    std::vector<double> m_rowWeights;  ///< p (1 - p)
    std::vector<double> m_residual;    ///< Z'(y - p)
    Matrix m_weights;                  ///< Z'WZ, lower triangle
    // Of the mode held.
    std::vector<double> m_heldLogOdds;
    std::vector<double> m_heldProbability;
    std::vector<double> m_heldRowWeights;
    Matrix m_heldWeights;
};

}  // namespace stats
