// The work of `vis2hap display calibrate`: a table of grey levels and friction becomes the response of a display.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rendering/response/display_response.h"

namespace study::commands {

struct DisplayCalibration {
    std::string table, out;
    std::string picture;           ///< SVG file; empty: none
    std::vector<std::string> map;  ///< "MEANING=COLUMN"
    std::optional<double> loadN;   ///< where the table has no column of it
    rendering::ResponseSetting setting;
};

/// Writes the response and its picture, and prints the table. Returns the exit code. Throws badInput and writes nothing for a
/// table that gives no response.
int calibrateDisplay(const DisplayCalibration& call);

}  // namespace study::commands
