// PNG files whose compression and checksums are made here, so that a change of their content reaches the decoder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// The file of these parts: the 13 bytes of the header, then chunks. A chunk has a name of four letters, the length of its body
/// in two bytes, the higher one first, and its body, which is cut where the parts end. The body of an IDAT are rows that are
/// compressed here. Checksums and the last chunk are added.
std::string pngOf(std::string_view parts);

/// Parts of sound images: every kind of colour with every number of bits, in one pass and interlaced, with palettes, transparent
/// colours and every orientation that a camera states.
std::vector<std::string> partsOfPngs();

}  // namespace fuzz
