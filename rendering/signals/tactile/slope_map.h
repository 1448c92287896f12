// Map from the light of a pixel (one number for each channel and, for uneven lamps, its place) to dh/dx and dh/dy.
// Linear is the fastest, the polynomial is the usual choice, the small network is the most flexible.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <variant>
#include <vector>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// [dh/dx, dh/dy] = gain * light + offset, mm/mm.
struct LinearMap {
    std::array<std::vector<double>, 2> gain;  ///< one number for each channel
    std::array<double, 2> offset{};
    bool operator==(const LinearMap&) const = default;
};

/// All monomials up to `degree` of the inputs: the light times lightScale and, if byPlace, the place. The place is u (to
/// the right) and v (downwards), both -1 to 1 over the frame. Their order is that of monomials().
struct PolynomialMap {
    int degree = 3;
    bool byPlace = true;
    double lightScale = 4;
    std::array<std::vector<double>, 2> coefficients;
    bool operator==(const PolynomialMap&) const = default;
};

/// The same inputs through layers of tanh and a linear last layer. The output without light is subtracted. Weights are stored
/// row by row, each row with its bias last.
struct NetworkMap {
    bool byPlace = true;
    double lightScale = 4;
    std::vector<int> sizes;                    ///< units of each layer, from the inputs to the 2 outputs
    std::vector<std::vector<double>> weights;  ///< [i]: weights of layer i + 1, sizes[i + 1] x (sizes[i] + 1)
    bool operator==(const NetworkMap&) const = default;
};

using SlopeMap = std::variant<LinearMap, PolynomialMap, NetworkMap>;

/// "linear", "polynomial", "network".
std::string_view kindOf(const SlopeMap& map);

/// Product of inputs: a parent with one factor fewer (-1 for the constant), times an input.
struct Monomial {
    int parent = -1;  ///< index in the list of monomials
    int factor = -1;  ///< index of the input
};
/// All products of at most `degree` of `inputs` numbers: the constant first, every parent before its children.
std::vector<Monomial> monomials(int inputs, int degree);

/// CV_32FC1 each. `light`: CV_32FC(n); n must be the number of channels of the map (asserted).
Slopes slopesOf(const SlopeMap& map, const cv::Mat& light);

/// Coordinate of a pixel along an axis of `length` pixels: -1 for the first, 1 for the last.
float frameCoordinate(int index, int length);

}  // namespace rendering::signals
