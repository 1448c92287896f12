// The lines from the app to vis2hap-sound, one JSON object a line.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace study::participant {

/// Root mean square of the masking noise, 0 to 0.3 of full scale.
struct NoiseLevel {
    double level = 0;
    bool operator==(const NoiseLevel&) const = default;
};
/// WAV files to play one after another, in place of those that still play.
struct PlayFiles {
    std::vector<std::string> files;
    bool operator==(const PlayFiles&) const = default;
};
using LineToSound = std::variant<NoiseLevel, PlayFiles>;

std::string lineOf(const LineToSound& line);
/// Throws badInput for anything that lineOf() does not write, and for more than 40 files.
LineToSound lineToSound(std::string_view text);

}  // namespace study::participant
