// Reading and writing the image files of a data set without OpenCV's codecs (they load 63 MB of
// GDAL): PNG through libpng, 32-bit float TIFF through libtiff, .npy (version 1, C order, little
// endian), and PGM for stimuli, whose files all have the same size.
// Colour is in R, G, B order everywhere in this program.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "protocols/files/whole_file.h"

namespace rendering {

/// CV_8UC1, CV_8UC3 (RGB), CV_16UC1 or CV_16UC3; palettes expanded, transparency dropped.
/// Throws badInput naming the file: missing, not a PNG, truncated, larger than 2^28 pixels.
cv::Mat readPng(const std::filesystem::path& file);

/// 8 or 16 bits, grey or RGB. All writers leave the whole file or what stood there before, and throw environmentFault.
void writePng(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync = protocols::Sync::Now);

/// One-channel CV_32F or CV_8U / CV_16U. Throws badInput.
cv::Mat readTiff(const std::filesystem::path& file);

/// CV_32FC1, deflate with the floating-point predictor.
void writeTiff(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync = protocols::Sync::Now);

/// One- or two-dimensional arrays (or [h x w x 3] images) of f4, f8, u1, u2, i4, i8: CV_32F, CV_64F, CV_8U, CV_16U as stored;
/// integers wider than 16 bits become CV_64F. A one-dimensional array is one row. Throws badInput.
cv::Mat readNpy(const std::filesystem::path& file);
void writeNpy(const std::filesystem::path& file, const cv::Mat& array, protocols::Sync sync = protocols::Sync::Now);

/// 8-bit grey, binary (P5): header "P5\n<width> <height>\n255\n" then the rows.
cv::Mat readPgm(const std::filesystem::path& file);
void writePgm(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync = protocols::Sync::Now);

/// By the file's ending: .png, .tif/.tiff, .npy, .pgm. Throws badInput for any other.
cv::Mat readImage(const std::filesystem::path& file);

}  // namespace rendering
