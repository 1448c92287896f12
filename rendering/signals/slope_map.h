// What a sensor's light tells of the slope: a map from the light of a pixel (one number a channel, and for
// uneven lamps its place) to dh/dx and dh/dy. Linear is the fast one, the polynomial the usual one, the small
// network the most pliant.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <variant>
#include <vector>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// [dh/dx, dh/dy] = gain * light + offset, mm/mm.
struct LinearMap {
    std::array<std::vector<double>, 2> gain;  ///< a number a channel
    std::array<double, 2> offset{};
    bool operator==(const LinearMap&) const = default;
};

/// All monomials up to `degree` of the light times lightScale and, where byPlace, of the place: u to the right and v downwards,
/// both -1..1 over the frame. In the order of `monomials`.
struct PolynomialMap {
    int degree = 3;
    bool byPlace = true;
    double lightScale = 4;
    std::array<std::vector<double>, 2> coefficients;
    bool operator==(const PolynomialMap&) const = default;
};

/// The same inputs through layers of tanh; the last layer is linear; less what it gives without light. Weights row by row, the
/// bias last in each.
struct NetworkMap {
    bool byPlace = true;
    double lightScale = 4;
    std::vector<int> sizes;                    ///< units of each layer, inputs first, 2 last
    std::vector<std::vector<double>> weights;  ///< of layer i + 1: sizes[i + 1] x (sizes[i] + 1)
    bool operator==(const NetworkMap&) const = default;
};

using SlopeMap = std::variant<LinearMap, PolynomialMap, NetworkMap>;

/// "linear", "polynomial", "network".
std::string_view kindOf(const SlopeMap& map);

/// A product of inputs: its own parent (one factor fewer; -1: the constant) and the factor that is put to it.
struct Monomial {
    int parent = -1;
    int factor = -1;
};
/// Of all products of at most `degree` of `inputs` numbers, the constant first, every parent before its children.
std::vector<Monomial> monomials(int inputs, int degree);

/// CV_32FC1 each. `light`: CV_32FC(n), n as the map has channels (an assertion).
Slopes slopesOf(const SlopeMap& map, const cv::Mat& light);

/// Pixels whose slopes are known, from one or several frames.
struct SlopeSamples {
    int channels = 3;
    std::vector<float> light;   ///< `channels` numbers a sample
    std::vector<float> places;  ///< u, v of each
    std::vector<float> slopes;  ///< dh/dx, dh/dy of each
    std::size_t size() const { return slopes.size() / 2; }
    /// The pixels of a frame where `chosen` (CV_8UC1) is not 0, every `step`-th of them.
    void add(const cv::Mat& light, const Slopes& slopes, const cv::Mat& chosen, int step = 1);
};

enum class MapQuality { Fast, Balanced, Accurate };  ///< linear, polynomial, network

struct FitOptions {
    MapQuality quality = MapQuality::Balanced;
    bool byPlace = true;
    int degree = 3;
    double lightScale = 4;
    double ridge = 1e-6;        ///< per sample; inputs are about 1
    std::uint64_t seed = 1;     ///< of the network's first weights
    int networkSamples = 6000;  ///< no more than these are used, evenly drawn
    int networkSteps = 300;
};

/// Least squares of maps without slope where the light is that of the untouched sensor (networks: less their slope there). Then
/// the whole is scaled so that it does not flatten: light is measured with noise, slopes are known, and the plain fit of slopes
/// on light comes out too small by the share of variance that it does not explain. Throws badInput for fewer samples than ten
/// times the numbers to be found.
SlopeMap fitSlopeMap(const SlopeSamples& samples, const FitOptions& options = {});

}  // namespace rendering::signals
