// Second differences along the columns of an image, inverted. With mirrored borders they factor into two recursions of first
// order, one down and one up (Unser, Aldroubi and Eden, 1993, use the same for splines), so a column costs two products a pixel.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace rendering::signals {

/// Solves (2 + stiffness[j]) u[i][j] - u[i - 1][j] - u[i + 1][j] = values[i][j] for each column j, where the rows beyond a border
/// repeat the last one. `values`: CV_32FC1 or CV_64FC1; it is replaced by u. `stiffness`: one for each column, not negative and
/// ascending. A column without stiffness determines u but for its mean, which becomes 0; the mean of its values is ignored.
void solveMirroredColumns(cv::Mat& values, const std::vector<double>& stiffness);

}  // namespace rendering::signals
