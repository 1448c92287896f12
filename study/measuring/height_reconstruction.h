// Heights in mm from tactile frames, from gradients or from a normal map, each with its quality figures.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rendering/signals/tactile/photometric_stereo.h"
#include "rendering/signals/tactile/press_folder.h"

namespace study::measuring {

/// Options that hold for every source of heights.
struct HeightOptions {
    std::optional<double> cutoffMm;  ///< removes longer waves; for frames the calibration's own is the default
    rendering::signals::IntegrationQuality quality = rendering::signals::IntegrationQuality::Full;
};

/// How slopes were sampled and where they were measured.
struct SlopeSampling {
    rendering::signals::Pitch pitch;
    rendering::signals::SlopeKind kind = rendering::signals::SlopeKind::Point;
    std::filesystem::path mask;  ///< image, 0: not measured; empty: measured wherever both slopes are numbers
};

/// The direction of y in a normal map. Auto takes the one whose slopes can be integrated better.
enum class NormalsY { Auto, Up, Down };

/// Where an object touches the sensor. Auto: in a part where the frame has places without contact, else everywhere.
struct ContactChoice {
    enum class Where { Auto, Whole, Part, Mask };
    Where where = Where::Auto;
    std::filesystem::path mask;  ///< for Where::Mask: image, 0: no contact
};

struct Reconstruction {
    std::string name;  ///< name of the measurement: the file's name without its ending
    rendering::signals::Slopes slopes;
    cv::Mat heightMm;              ///< CV_32FC1, at least 0
    nlohmann::ordered_json facts;  ///< what was done, and the figures; for the file beside the height
};

/// Slopes dh/dx and dh/dy in mm/mm. The lowest place becomes 0. Throws badInput: slopes of different sizes, heights that
/// exceed the range of 32-bit numbers.
Reconstruction fromGradients(const std::filesystem::path& alongX, const std::filesystem::path& alongY,
                             const SlopeSampling& sampling, const HeightOptions& options);

/// A normal map, (n + 1) / 2 as RGB. `decodeOther` reads the image formats that this program has no reader for.
Reconstruction fromNormals(const std::filesystem::path& map, NormalsY y, const SlopeSampling& sampling,
                           const HeightOptions& options, const rendering::Decode& decodeOther);

struct FramesRequest {
    std::vector<std::filesystem::path> frames;  ///< colour, or grey in the order of the sensor's lamps
    std::filesystem::path calibration;
    std::filesystem::path background;  ///< the untouched sensor; empty: the one saved beside the calibration
    ContactChoice contact;
};

/// One height a measurement. Throws badInput: a frame that the calibrated sensor cannot have taken, two frames with the same
/// name, frames left over for a sensor with several lamps, no background.
std::vector<Reconstruction> fromFrames(const FramesRequest& request, const HeightOptions& options,
                                       const rendering::Decode& decodeOther);

}  // namespace study::measuring
