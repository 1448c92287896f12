// A second, direct solution of the heights around gaps, in double precision.
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

#include "rendering/signals/known_places.h"
#include "rendering/signals/slope_differences.h"

namespace rendering::signals {

/// The same least squares as integrateAround() for point and forward slopes: rises at a gap have a thousandth of the weight.
/// Solved by elimination in a band matrix, for maps of a few thousand points.
class DirectSolution {
public:
    DirectSolution(const Slopes& slopes, const cv::Mat& known, const Pitch& pitch, SlopeKind kind)
        : m_columns(known.cols),
          m_matrix(cv::Mat::zeros(known.rows * known.cols, known.cols + 1, CV_64FC1)),
          m_values(cv::Mat::zeros(known.rows * known.cols, 1, CV_64FC1))
    {
        cv::Mat knownX = known.clone(), knownY = known.clone();
        if (kind == SlopeKind::Forward) knownX.col(known.cols - 1) = 0;
        if (kind == SlopeKind::Forward) knownY.row(known.rows - 1) = 0;
        const auto rises = SlopeDifferences<double>(known.size(), pitch, kind)
                               .between({continued(slopes.x, knownX), continued(slopes.y, knownY)});
        const auto add = [&](const cv::Mat& rise, double step, int i, int j, int down, int right) {
            if (i + down >= known.rows || j + right >= known.cols) return;
            const bool measured = known.at<uchar>(i, j) && known.at<uchar>(i + down, j + right);
            couple(i * m_columns + j, down * m_columns + right, (measured ? 1 : 1e-3) / (step * step),
                   step * rise.at<double>(i, j));
        };
        for (int i = 0; i < known.rows; ++i)
            for (int j = 0; j < known.cols; ++j) {
                add(rises.x, pitch.x, i, j, 0, 1);
                add(rises.y, pitch.y, i, j, 1, 0);
            }
        m_matrix.at<double>(0, 0) += 1 / (pitch.x * pitch.y);  // The first height is 0.
    }

    /// CV_64FC1, mean 0. It may be called once.
    cv::Mat height()
    {
        const int size = m_matrix.rows, band = m_columns;
        for (int k = 0; k < size; ++k) {
            const int end = std::min(band, size - 1 - k);
            const double* own = m_matrix.ptr<double>(k);
            for (int a = 1; a <= end; ++a) {
                const double share = own[a] / own[0];
                double* lower = m_matrix.ptr<double>(k + a);
                for (int b = a; b <= end; ++b) lower[b - a] -= share * own[b];
                m_values.at<double>(k + a) -= share * m_values.at<double>(k);
            }
        }
        for (int k = size - 1; k >= 0; --k) {
            for (int a = 1; a <= std::min(band, size - 1 - k); ++a)
                m_values.at<double>(k) -= m_matrix.at<double>(k, a) * m_values.at<double>(k + a);
            m_values.at<double>(k) /= m_matrix.at<double>(k, 0);
        }
        const cv::Mat height = m_values.reshape(1, size / m_columns);
        return height - cv::mean(height)[0];
    }

private:
    void couple(int point, int ahead, double weight, double rise)
    {
        m_matrix.at<double>(point, 0) += weight;
        m_matrix.at<double>(point + ahead, 0) += weight;
        m_matrix.at<double>(point, ahead) -= weight;
        m_values.at<double>(point) -= weight * rise;
        m_values.at<double>(point + ahead) += weight * rise;
    }

    int m_columns;
    cv::Mat m_matrix;  ///< row k: elements from the diagonal to the right
    cv::Mat m_values;
};

}  // namespace rendering::signals
