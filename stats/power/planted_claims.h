// Simulated studies with a planted difference: how often the claims of the report find it, beside the linear mixed model of the
// two conditions alone (two_condition_model.h), and how often the 95 % intervals hold the truth.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "stats/power/claim_studies.h"

namespace stats {

/// A model that studies are drawn from. One condition, the first of the first contrast, has a mean that is `difference` points
/// above those of the others. With unequal interactions it is also the condition with the larger SD. Ratings are not limited to
/// the ends of the scale, so that the true difference is known.
struct PlantedTruth {
    ClaimNull interactions;
    double difference = 0;  ///< scale points; 0 for choices, whose share is 0.6 under every condition

    std::string text() const;
};

/// Ratings: all interactions of claimNulls() with differences of 0, 0.5, 1 and 2. Choices: all interactions, no difference.
std::vector<PlantedTruth> plantedTruths();

/// Mean over studies of a share that each study has: of its `each` decisions or intervals. The sums are whole numbers, so that
/// they do not depend on the order of the studies.
struct StudyMean {
    std::size_t studies = 0;
    double sum = 0;  ///< of counts from -each to each
    double sumOfSquares = 0;
    std::size_t each = 1;  ///< decisions or intervals of one study

    void add(double count);
    double mean() const;
    double se() const;  ///< Monte-Carlo standard error
    bool operator==(const StudyMean&) const = default;
};

/// One decision or one interval. A decision is right if the planted difference is called different with the right sign, or if
/// conditions whose difference lies within the bounds are called equivalent.
struct PlantedRow {
    std::string name;  ///< "different, first contrast", "equivalent within 1, after Holm of 36", "interval holds the truth"
    bool isCoverage = false;  ///< the interval of every pair of conditions; else a decision on the first contrast
    StudyMean these;          ///< studies drawn so that the truth holds on their fabrics
    StudyMean alike;
    StudyMean reference;            ///< the model of the two conditions, on the studies of `alike`
    StudyMean alikeMinusReference;  ///< its standard error is that of the paired difference

    bool operator==(const PlantedRow&) const = default;
};

struct PlantedCell {
    PlantedTruth truth;
    std::vector<PlantedRow> rows;
};

struct PlantedOptions {
    StudyDesign design;
    RatingTruth ratings;                  ///< centre and step of the scale
    std::vector<ContrastPair> contrasts;  ///< the planned ones, the primary one first; empty: conditions 0 and 1, and all pairs
    bool hasRatings = true;
    bool hasChoices = true;
    SimulationOptions simulation;
    /// Rows of an earlier run that was interrupted, of `studies` studies each; empty where this truth was not counted.
    std::function<std::vector<PlantedRow>(const std::string& truth, std::size_t studies)> counted = {};
    /// Gets the rows of a truth as soon as they are finished.
    std::function<void(const std::string& truth, const std::vector<PlantedRow>& rows)> finished = {};
};

/// One cell for each truth. Needs at least 2 participants, fabrics and conditions.
PlantedCell plantedCell(const PlantedTruth& truth, const PlantedOptions& options);
std::vector<PlantedCell> plantedCells(const PlantedOptions& options);

/// Number of simulated studies in all, for a progress display.
std::size_t plantedClaimStudies(const PlantedOptions& options);

}  // namespace stats
