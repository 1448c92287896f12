// Linear and polynomial maps are fitted by ridge regression. The network is trained by resilient propagation (Igel &
// Huesken 2000, iRprop-), which needs no step size.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rendering/signals/surface_integration.h"
#include "rendering/signals/tactile/slope_map.h"

namespace rendering::signals {

/// Pixels of known slope from one or several frames.
struct SlopeSamples {
    int channels = 3;
    std::vector<float> light;   ///< `channels` numbers for each sample
    std::vector<float> places;  ///< u, v of each sample
    std::vector<float> slopes;  ///< dh/dx, dh/dy of each sample
    std::size_t size() const { return slopes.size() / 2; }
    /// Adds every `step`-th of the pixels where `chosen` (CV_8UC1) is not 0.
    void add(const cv::Mat& light, const Slopes& slopes, const cv::Mat& chosen, int step = 1);
};

enum class MapQuality { Fast, Balanced, Accurate };  ///< linear, polynomial, network

struct FitOptions {
    MapQuality quality = MapQuality::Balanced;
    bool byPlace = true;
    int degree = 3;
    double lightScale = 4;
    double ridge = 1e-6;        ///< for each sample; inputs are about 1
    std::uint64_t seed = 1;     ///< seed for the initial weights of the network
    int networkSamples = 6000;  ///< maximum number of samples, evenly drawn
    int networkSteps = 300;
};

/// Fits a map by least squares. Its slope is 0 where the light is that of the untouched sensor. Light is measured with
/// noise, so plain regression of slope on light is too small by the unexplained share of the variance. The fit is corrected
/// for this attenuation. Throws badInput for fewer samples than ten times the number of unknowns.
SlopeMap fitSlopeMap(const SlopeSamples& samples, const FitOptions& options = {});

}  // namespace rendering::signals
