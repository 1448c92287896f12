// A response as a picture: the measured means with their intervals, rising and falling levels apart, the curve, its dead zone and
// where it saturates.
#pragma once

#include <string>

#include "rendering/response/display_response.h"

namespace rendering {

/// An SVG file.
std::string responseDrawing(const DisplayResponse& response);

}  // namespace rendering
