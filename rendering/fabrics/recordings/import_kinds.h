// The importers behind importRecordings(), one a kind of input. Each reads and checks all of its
// input into the stage before anything of the data set changes, and returns its lines for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/import.h"
#include "rendering/fabrics/recordings/import_stage.h"

namespace rendering::fabrics {

using Lines = std::vector<std::string>;

Lines importPhotos(const ImportRequest& request, ImportStage& stage);
Lines importGelsight(const ImportRequest& request, ImportStage& stage);
Lines importFrictionFiles(const ImportRequest& request, ImportStage& stage);

/// A stroke as an instrument recorded it, before it is brought to even time steps.
struct RawRecord {
    std::string where = {};       ///< file, and the part of it
    std::string instrument = {};  ///< "slide", "tribometer", ...
    std::string quantity = "mu";  ///< what `values` are; unused where forces are given
    std::string meaning = {};     ///< for people: "coefficient = Traction Force / Pin Load"
    std::vector<double> timeS = {};
    std::vector<double> values = {};             ///< the quantity, or the tangential force where `normalN` is given
    std::vector<double> secondTangentialN = {};  ///< of the axis across; empty where there is one axis
    std::vector<double> normalN = {};            ///< as the sensor signs it; empty unless both forces are known
    std::optional<double> speedMmPerS = {};
};

std::vector<RawRecord> readFrictionCsv(const std::filesystem::path& file, const FrictionOptions& options);
std::vector<RawRecord> readTribometer(const std::filesystem::path& file, const FrictionOptions& options);
std::vector<RawRecord> readLabview(const std::filesystem::path& file, const FrictionOptions& options);
std::vector<RawRecord> readSlide(const std::filesystem::path& file, const FrictionOptions& options);

/// A header such as "Fn [mN]", "fx_N" or "time_ms" taken apart, in lower case.
struct NameWithUnit {
    std::string name, unit;
};
NameWithUnit takenApart(const std::string& header);

/// Newtons in the unit that a header states, or in the options' where it states none. Throws badInput for an
/// unknown one.
double newtonsOf(const std::string& header, const FrictionOptions& options, const std::string& where);

/// "coefficient of friction = ..." of axes that were joined or not.
std::string meaningOf(const std::vector<std::string>& tangential, const std::string& normal);

/// Without carriage returns; Latin-1 bytes become UTF-8.
std::string asUtf8(std::string_view latin1);
/// UTF-8 as it is; other bytes taken for Latin-1. For names in messages, pictures and JSON.
std::string readable(const std::string& text);
/// Lines of a text, which must outlive them.
std::vector<std::string_view> linesOf(std::string_view text);
std::vector<std::string_view> splitAt(std::string_view line, char separator);

}  // namespace rendering::fabrics
