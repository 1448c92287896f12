// Real recordings into a data set. Each importer refuses unusable input by file and reason, writes
// nothing on refusal, and adds to an existing data set.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/recordings/friction_options.h"

namespace rendering::fabrics {

enum class ImportKind { Photos, Gelsight, FrictionCsv, Tribometer, Labview, Slide };
ImportKind importKindNamed(std::string_view name);  ///< throws badInput naming the kinds

/// The calibrated sensor that tactile frames are of.
struct ImportedSensor {
    std::string calibration;  ///< text of its file
    double mmPerPixel = 0;
    cv::Mat untouched;  ///< the frame saved with the calibration; empty: one must be among the files
    /// Throws badInput where a reference frame is another sensor's; `where` names it.
    std::function<void(const cv::Mat& reference, const std::string& where)> requireSame;
};

struct ImportRequest {
    ImportKind kind = ImportKind::Photos;
    std::vector<std::filesystem::path> from;  ///< files or folders
    std::filesystem::path out;
    std::optional<protocols::FabricId> fabric;  ///< put all into this fabric
    /// Decodes what image_io does not read (JPEG, BMP ...): the caller lends one, so that the
    /// importers link no codec. Returns CV_8UC3 RGB, throws badInput.
    std::function<cv::Mat(const std::filesystem::path&)> decodeOther;
    std::optional<ImportedSensor> sensor = {};  ///< of tactile frames
    FrictionOptions friction = {};              ///< of friction records
    std::filesystem::path plots = {};           ///< folder for a picture of each stroke, F01-000.svg; empty: none
};

/// What was imported, a line each for people: "F01 Linen: slide, 812 samples, taxel_sum_counts (counts, not a coefficient), ...".
std::vector<std::string> importRecordings(const ImportRequest& request);

}  // namespace rendering::fabrics
