// The differences of a surface that a kind of slope measures, as a linear map that the cosine transform makes diagonal:
// what surface_integration solves with. Along each axis either rises between neighbours (Point, Forward) or central
// differences whose mirrored borders carry half the weight (Central).
#pragma once

#include <vector>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// T: float or double; all images hold it, of one size. Where there is no difference (the last column of
/// rises along x, the last row along y) it is 0.
template <class T>
class Differences {
public:
    Differences(cv::Size size, const Pitch& pitch, SlopeKind kind);

    /// The measured slopes in the form of `of`.
    Slopes between(const Slopes& slopes) const;
    Slopes of(const cv::Mat& height) const;
    cv::Mat transposed(const Slopes& differences) const;
    /// transposed(between(slopes)); for point slopes in one pass over them.
    cv::Mat sources(const Slopes& slopes) const;
    /// Height of mean 0 with transposed(of(height)) == sources.
    cv::Mat surfaceOf(const cv::Mat& sources) const;
    /// 1 for a difference between measured places, else `weightOfGaps`.
    Slopes weights(const cv::Mat& measured, double weightOfGaps) const;

private:
    bool central() const { return m_kind == SlopeKind::Central; }

    cv::Size m_size;
    Pitch m_pitch;
    SlopeKind m_kind;
    std::vector<T> m_alongX, m_alongY;  ///< eigenvalues
};

extern template class Differences<float>;
extern template class Differences<double>;

}  // namespace rendering::signals
