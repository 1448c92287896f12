// Whether a photograph shows cloth. A logistic regression on cloth_features.h, fitted to drawn cloth and to drawn pictures of
// other things; no fabric and no picture of anybody is stored. Dye, exposure, focus and scale vary in both, so they decide
// nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rendering/models/cloth/cloth_features.h"

namespace rendering::models {

enum class ClothLikeness {
    Cloth,    ///< like 95 % of drawn cloth
    Unusual,  ///< as only one drawn cloth in twenty: signals are doubtful
    NotCloth  ///< as hardly any drawn cloth: black, a portrait, text, a landscape, a plain colour
};
std::string nameOf(ClothLikeness likeness);  ///< "cloth", "unusual", "not_cloth"

struct ClothCheck {
    ClothFeatures mean{}, deviation{};  ///< of drawn cloth
    std::vector<double> weights;        ///< 2 x clothFeatureCount + 1: of the features, their squares, and a constant
    double unusualAbove = 0, refusedAbove = 0;
    std::uint64_t seed = 0;
    int pictures = 0;  ///< of each kind in the fit

    double score(const cv::Mat& rgb) const;  ///< log odds that the picture (CV_8UC3, RGB) is no cloth
    ClothLikeness likenessOf(double score) const;
    ClothLikeness judge(const cv::Mat& rgb) const { return likenessOf(score(rgb)); }
};

/// Fits to `pictures` drawn photographs of cloth and as many other pictures of the family `seed`, at least 100. The limits leave
/// 5 % and 1 % of other drawn cloth outside. `report`: pictures done, of how many.
ClothCheck fitClothCheck(std::uint64_t seed, int pictures, unsigned threads, const std::function<void(int, int)>& report = {});

/// Photograph `index` of drawn cloth as the fit shows it: ordinary photographs and colours of scans, of 128 to 384 px.
cv::Mat drawnClothPicture(std::uint64_t seed, std::uint64_t index);

/// Shares of `pictures` drawn pictures of the family `seed`, which must not be that of the fit nor its complement.
struct ClothCheckFigures {
    double clothUnusual = 0, clothRefused = 0, othersRefused = 0;
};
ClothCheckFigures clothCheckFigures(const ClothCheck& check, std::uint64_t seed, int pictures);

/// JSON {"schema":"vis2hap.cloth_check/1",...}. Throws environmentFault where it cannot be written.
void writeClothCheck(const std::filesystem::path& file, const ClothCheck& check);
ClothCheck readClothCheck(const std::filesystem::path& file);  ///< throws badInput naming file and field

/// The check that comes with the program, read once. Throws badInput where it is missing.
const ClothCheck& shippedClothCheck();

}  // namespace rendering::models
