// Identification of the fabric from a signal: linear discriminant analysis of signal features, fitted on measured signals.
// It classifies generated signals, and measured ones as an upper limit.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "study/evaluation/friction_comparison.h"
#include "study/evaluation/height_comparison.h"

namespace study::evaluation {

using FeatureVector = std::vector<double>;

/// Logarithms of the features. A flat map or a constant trace has their lowest values.
FeatureVector featureVector(const HeightFeatures& features);
FeatureVector featureVector(const FrictionFeatures& features);

/// Classifier by the nearest class mean under the pooled within-class covariance. The covariance is shrunk towards its diagonal
/// by p / (p + degrees of freedom), so fewer samples give more shrinkage.
class Identifier {
public:
    /// Fits the classifier on one list of vectors for each class. Vectors shorter than the longest are of signals that were too
    /// small for all features, and are left out. A class without vectors is never chosen.
    explicit Identifier(const std::vector<std::vector<FeatureVector>>& samplesOfClass);

    /// Index of the class; none if fewer than two classes have samples or if the length of the vector differs.
    std::optional<std::size_t> classOf(const FeatureVector& features) const;

private:
    std::vector<FeatureVector> m_means;  ///< means of the classes; empty for a class without samples
    cv::Mat m_precision;                 ///< inverse of the shrunk covariance, [p × p]
    std::size_t m_classes = 0;           ///< number of classes with samples
};

}  // namespace study::evaluation
