// Work on the rows of an image, on several threads.
#pragma once

#include <numeric>
#include <opencv2/core.hpp>
#include <vector>

namespace rendering::signals {

/// Calls work(row) for every row, on several threads.
template <class Work>
void forRows(int rows, Work work)
{
    cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) work(i);
    });
}

/// Sum of row(i); the order of the additions does not depend on the number of threads.
template <class Row>
double sumOfRows(int rows, Row row)
{
    std::vector<double> sums(static_cast<std::size_t>(rows));
    forRows(rows, [&](int i) { sums[static_cast<std::size_t>(i)] = row(i); });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace rendering::signals
