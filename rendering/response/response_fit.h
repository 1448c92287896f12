// From measured pairs of grey level and friction to a response: means of repeats, the nearest curve that never falls (isotonic
// regression), and monotone cubics between the levels.
#pragma once

#include <string>
#include <vector>

#include "rendering/response/display_response.h"

namespace rendering {

enum class SweepDirection { Unknown, Up, Down };

struct FrictionAtLevel {
    int level = 0;        ///< 0 to 255
    double friction = 0;  ///< coefficient, not negative
    SweepDirection direction = SweepDirection::Unknown;
};

/// The response without setting and source. `where` names the measurements in errors. Throws badInput: fewer than `fewestLevels`
/// levels; friction that falls with the level, or does not change, beyond what repeats scatter (without repeats: by more, or
/// less, than a tenth of the range, or of the mean). A change of at most `flatShare` of the mean is always refused.
DisplayResponse fitResponse(const std::vector<FrictionAtLevel>& measurements, const std::string& where);

/// What a laboratory should know before it uses the response: one sentence each.
std::vector<std::string> remarksOn(const DisplayResponse& response);

/// Gives each measurement the direction in which the levels moved within its sweep; sweeps begin where `begins` is set.
void addDirections(std::vector<FrictionAtLevel>& measurements, const std::vector<bool>& begins);

}  // namespace rendering
