// The linear map from a surface to the differences that a kind of slope measures; surface_integration solves with it.
// The cosine transform makes it diagonal. The differences are rises between neighbours (Point, Forward), or central
// differences whose mirrored borders have half the weight (Central).
#pragma once

#include <vector>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// T: float or double; all images hold T and have one size. Entries without a difference (the last column of rises along x,
/// the last row along y) are 0.
template <class T>
class SlopeDifferences {
public:
    SlopeDifferences(cv::Size size, const Pitch& pitch, SlopeKind kind);

    /// Measured slopes as differences, comparable with those of `of`.
    Slopes between(const Slopes& slopes) const;
    /// Differences of a surface.
    Slopes of(const cv::Mat& height) const;
    cv::Mat transposed(const Slopes& differences) const;
    /// transposed(between(slopes)); for point slopes in a single pass.
    cv::Mat sources(const Slopes& slopes) const;
    /// Height of mean 0 that satisfies transposed(of(height)) == sources.
    cv::Mat surfaceOf(const cv::Mat& sources) const;
    /// Factors from the cosine transform of the sources to that of the height, as surfaceOf() applies them.
    cv::Mat heightFactors() const;
    /// 1 for a rise between two measured places, else `weightOfGaps`. Not for central differences.
    Slopes weights(const cv::Mat& measured, double weightOfGaps) const;

private:
    cv::Mat surfaceOfRises(const cv::Mat& sources) const;
    bool central() const { return m_kind == SlopeKind::Central; }

    cv::Size m_size;
    Pitch m_pitch;
    SlopeKind m_kind;
    std::vector<T> m_alongX, m_alongY;  ///< eigenvalues for each frequency
};

extern template class SlopeDifferences<float>;
extern template class SlopeDifferences<double>;

}  // namespace rendering::signals
