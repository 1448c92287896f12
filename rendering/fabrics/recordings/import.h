// Import of real recordings into a data set. Each importer names the file and the reason where it refuses input,
// and then writes nothing. An existing data set is extended.
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

/// Kinds whose files become one signal. Scanned materials have an importer of their own, rendering/scans.
enum class ImportKind { Photos, Gelsight, FrictionCsv, Tribometer, Labview, Slide };
ImportKind importKindNamed(std::string_view name);  ///< throws badInput naming the kinds

/// The calibrated sensor that recorded the tactile frames.
struct ImportedSensor {
    std::string calibration;  ///< text of its calibration file
    double mmPerPixel = 0;
    cv::Mat untouched;  ///< frame saved with the calibration; if empty, the imported files must contain one
    /// Throws badInput where a reference frame comes from another sensor; `where` names the frame.
    std::function<void(const cv::Mat& reference, const std::string& where)> requireSame;
};

struct ImportRequest {
    ImportKind kind = ImportKind::Photos;
    std::vector<std::filesystem::path> from;  ///< files or folders
    std::filesystem::path out;
    std::optional<protocols::FabricId> fabric;  ///< if set, all samples belong to this fabric
    /// Decodes the formats that image_io does not read (JPEG, BMP and others). The caller passes it, so that the
    /// importers link no codec. Returns CV_8UC3 RGB; throws badInput.
    std::function<cv::Mat(const std::filesystem::path&)> decodeOther;
    std::optional<ImportedSensor> sensor = {};  ///< for tactile frames
    FrictionOptions friction = {};              ///< for friction records
    std::filesystem::path plots = {};           ///< folder for a picture of each stroke, F01-000.svg; empty: no pictures
    std::optional<Fibre> fibre = {};            ///< of all fabrics that are imported
};

/// Imports and returns a report, one line each: "F01 Linen: slide, 812 rows, taxel_sum_counts (sum of 16 taxels in counts)".
std::vector<std::string> importRecordings(const ImportRequest& request);

}  // namespace rendering::fabrics
