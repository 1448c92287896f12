// Which fabric a signal sounds like: a linear discriminant over what tells fabrics apart, fitted on measured signals.
// The judge of generated signals, and of measured ones, whose score is the ceiling.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "study/evaluation/friction_comparison.h"
#include "study/evaluation/height_comparison.h"

namespace study::evaluation {

using FeatureVector = std::vector<double>;

/// Logarithms; a flat map or a constant trace lies at their floor.
FeatureVector featureVector(const HeightFeatures& features);
FeatureVector featureVector(const FrictionFeatures& features);

/// Nearest class mean under the pooled covariance within classes, shrunk towards its diagonal by
/// p / (p + degrees of freedom): few samples, more shrinkage.
class Identifier {
public:
    /// One list of equally long vectors a class; classes without vectors are never chosen.
    explicit Identifier(const std::vector<std::vector<FeatureVector>>& samplesOfClass);

    /// None where fewer than two classes have samples, or the vector is of another length.
    std::optional<std::size_t> classOf(const FeatureVector& features) const;

private:
    std::vector<FeatureVector> m_means;  ///< empty: no samples
    cv::Mat m_precision;                 ///< [p x p], the inverse of the shrunk covariance
    std::size_t m_classes = 0;           ///< with samples
};

}  // namespace study::evaluation
