// Bytes of a small TrueMap file, for tests of its reader.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

namespace tests::support {

/// `heightMm`: CV_32FC1, continuous. The comment and the extent of 1 mm by 1 mm are fixed.
inline std::string trueMapBytes(const cv::Mat& heightMm)
{
    std::string bytes("Binary TrueMap Data File v2.0\r\n", 31);
    bytes += std::string("\0comment\0", 9);
    const std::uint32_t size[] = {static_cast<std::uint32_t>(heightMm.cols), static_cast<std::uint32_t>(heightMm.rows)};
    const float extent[] = {1, 1, 0, 0};
    bytes.append(reinterpret_cast<const char*>(size), sizeof size);
    bytes.append(reinterpret_cast<const char*>(extent), sizeof extent);
    return bytes.append(reinterpret_cast<const char*>(heightMm.data), heightMm.total() * sizeof(float));
}

}  // namespace tests::support
