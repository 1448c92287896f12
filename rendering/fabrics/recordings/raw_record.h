// A stroke as an instrument recorded it, before resampling to even time steps.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rendering::fabrics {

struct RawRecord {
    std::string where = {};       ///< file, and the part of it
    std::string instrument = {};  ///< "slide", "tribometer", ...
    std::string quantity = "mu";  ///< name of the quantity in `values`; unused where `normalN` is given
    std::string meaning = {};     ///< definition for people: "coefficient = Traction Force / Pin Load"
    std::string form = {};        ///< how an unusual table was read: "semicolons, decimal commas, UTF-8"
    /// Column of the time where its name states no unit, so that seconds are assumed; else empty.
    std::string timeWithoutUnit = {};
    std::vector<double> timeS = {};
    std::vector<double> values = {};             ///< the quantity, or the tangential force where `normalN` is given
    std::vector<double> secondTangentialN = {};  ///< second tangential axis; empty where there is only one
    std::vector<double> normalN = {};            ///< with the sign of the sensor; empty unless both forces are known
    std::optional<double> speedMmPerS = {};      ///< of the whole record; PreparedRecord has that of the kept rows
    std::vector<double> speedsMmPerS = {};       ///< of each row, where the instrument recorded it; with the sign of its drive
};

}  // namespace rendering::fabrics
