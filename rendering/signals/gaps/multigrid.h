// A multigrid cycle for the normal matrix of least squares over rises between neighbouring pixels: each point is coupled with its
// neighbours. The interpolation follows the couplings, so that gaps and edges of any form are kept on the coarse grids.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace rendering::signals {

/// Couplings of each point of a grid with its neighbours on the right, below, and (not on the finest grid) diagonally below.
/// A neighbour outside the grid has coupling 0.
struct Couplings {
    cv::Mat right, below, belowRight, belowLeft;

    cv::Size size() const { return right.size(); }
    bool diagonal() const { return !belowRight.empty(); }
};

/// A grid, and the interpolation to it from the next coarser one, whose points are every second one of it. Each coarse point
/// owns the square to its right and below; `share` holds what the points of this square take from the coarse ones.
struct Level {
    Couplings couplings;
    cv::Mat inverseDiagonal;  ///< of the couplings above 0; 0 at points without any
    /// CV_32FC(6): share that the point on the upper edge takes from its left end, that on the left edge from its upper end,
    /// and the middle from the corners: upper left, upper right, lower left, lower right.
    cv::Mat share;
    cv::Mat sources, found, spare;
};

/// Row i of the product of the normal matrix and `in`.
void multiplyRow(const Couplings& c, const cv::Mat& in, int i, float* out);

/// One cycle for the normal matrix.
class Multigrid {
public:
    /// CV_32FC1, at least 1 x 1.
    explicit Multigrid(Couplings couplings);

    const Couplings& finest() const { return m_levels.front().couplings; }

    /// Approximate solution for `sources`; valid until the next call.
    const cv::Mat& cycle(const cv::Mat& sources);

private:
    void solve(std::size_t at);

    std::vector<Level> m_levels;
};

}  // namespace rendering::signals
