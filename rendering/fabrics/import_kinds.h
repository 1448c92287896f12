// The importers behind importRecordings(), one a kind of input. Each reads and checks all of its
// input into the stage before anything of the data set changes, and returns its lines for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/fabrics/import.h"
#include "rendering/fabrics/import_stage.h"

namespace rendering::fabrics {

using Lines = std::vector<std::string>;

Lines importPhotos(const ImportRequest& request, ImportStage& stage);
Lines importGelsight(const ImportRequest& request, ImportStage& stage);
Lines importFrictionFiles(const ImportRequest& request, ImportStage& stage);

/// A stroke as an instrument recorded it, before it is brought to even time steps.
struct RawRecord {
    std::string where;            ///< file, and the part of it
    std::string instrument;       ///< "slide", "tribometer", ...
    std::string quantity = "mu";  ///< what `values` are; unused where forces are given
    std::string meaning;          ///< for people: "coefficient = Traction Force / Pin Load"
    std::vector<double> timeS;
    std::vector<double> values;   ///< the quantity, or the tangential force where `normalN` is given
    std::vector<double> normalN;  ///< empty unless both forces are known
    std::optional<double> speedMmPerS;
};

std::vector<RawRecord> readFrictionCsv(const std::filesystem::path& file);
std::vector<RawRecord> readTribometer(const std::filesystem::path& file);
std::vector<RawRecord> readLabview(const std::filesystem::path& file);
std::vector<RawRecord> readSlide(const std::filesystem::path& file);

/// Lines of a text without their ends (LF or CRLF); Latin-1 bytes become UTF-8.
std::vector<std::string> linesOfText(std::string_view bytes);
std::vector<std::string_view> splitAt(std::string_view line, char separator);

}  // namespace rendering::fabrics
