// Small valid files in the many forms that other programs write: TIFF, BMP, GIF and WAV.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fuzz {

/// A number, the lowest byte first.
std::string little(std::uint32_t value, int size);

/// Grey images of 8, 16 and 32 bits (floating point), and images of colours: compressed in each usual way with each predictor, in
/// one strip and in many, in both orders of bytes, as BigTIFF, in tiles and in planes. A form that libtiff cannot write is left
/// out. `scratch`: a file that is written again and again.
std::vector<std::string> greyTiffs(const std::filesystem::path& scratch);
std::vector<std::string> colourTiffs(const std::filesystem::path& scratch);

/// Bitmaps of 1 to 32 bits with the headers of Windows and OS/2, plain and run-length coded, and a GIF.
std::vector<std::string> drawnPictures();

/// One and two channels, 8 to 192 kHz, the extensible format, and a chunk of odd length before the samples.
std::vector<std::string> recordings();

}  // namespace fuzz
