// Image files of a data set, read and written without OpenCV's codecs, which load 63 MB of GDAL. PNG uses libpng
// and 32-bit float TIFF uses libtiff. .npy is read in version 1, C order, little endian. Stimuli are PGM files,
// because PGM files of one size in pixels also have one size in bytes.
// Colours are in the order R, G, B everywhere in this program.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "protocols/files/whole_file.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"

namespace rendering {

/// An array of one or two dimensions, or an image [h x w x 3]; one dimension gives one row. Elements f4, f8, u1 and u2
/// keep their type (CV_32F, CV_64F, CV_8U, CV_16U); other integers become CV_64F. Throws badInput.
cv::Mat readNpy(const std::filesystem::path& file);
void writeNpy(const std::filesystem::path& file, const cv::Mat& array, protocols::Sync sync = protocols::Sync::Now);

/// 8-bit grey, binary (P5): the header "P5\n<width> <height>\n255\n", then the rows.
cv::Mat readPgm(const std::filesystem::path& file);
void writePgm(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync = protocols::Sync::Now);

/// The bytes of a PGM file in memory. `where` names their source in errors.
std::string pgmBytes(const cv::Mat& image);
cv::Mat pgmOfBytes(std::string_view bytes, const std::filesystem::path& where);

/// Reads an image in the format of the file's ending: .png, .tif, .tiff, .npy or .pgm. A TIFF must have one channel;
/// readColourTiff() takes others. Throws badInput for any other ending.
cv::Mat readImage(const std::filesystem::path& file);

}  // namespace rendering
