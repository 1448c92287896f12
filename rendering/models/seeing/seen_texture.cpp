#include "rendering/models/seeing/seen_texture.h"

namespace rendering::models {

namespace {

namespace functional = torch::nn::functional;

constexpr std::int64_t shrink = 8;      ///< surroundings are averaged in a picture of this fraction
constexpr double darkest = 1.0 / 255;   ///< black has no logarithm
constexpr double leastVariance = 1e-4;  ///< of the logarithm: about 1 % of brightness, the noise of a good camera

torch::Tensor meanOfFive(const torch::Tensor& image)
{
    const torch::Tensor wide = functional::pad(image, functional::PadFuncOptions({2, 2, 2, 2}).mode(torch::kReplicate));
    return functional::avg_pool2d(wide, functional::AvgPool2dFuncOptions(5).stride(1));
}

/// Mean of the surroundings of every pixel.
torch::Tensor surroundings(const torch::Tensor& image)
{
    const torch::Tensor small = functional::avg_pool2d(image, functional::AvgPool2dFuncOptions(shrink));
    return functional::interpolate(meanOfFive(meanOfFive(small)),
                                   functional::InterpolateFuncOptions()
                                       .size(std::vector<std::int64_t>{image.size(2), image.size(3)})
                                       .mode(torch::kBilinear)
                                       .align_corners(false));
}

torch::Tensor againstSurroundings(const torch::Tensor& image) { return image - surroundings(image); }

/// Logarithms of the colour channels.
struct LogColours {
    explicit LogColours(const torch::Tensor& photograph) : all(photograph.clamp(darkest, 1).log()) {}
    torch::Tensor all, red = all.narrow(1, 0, 1), green = all.narrow(1, 1, 1), blue = all.narrow(1, 2, 1);
    torch::Tensor contrast() const { return againstSurroundings(0.30 * red + 0.59 * green + 0.11 * blue); }
};

}  // namespace

torch::Tensor seenContrast(const torch::Tensor& photograph) { return LogColours(photograph).contrast(); }

torch::Tensor seenTexture(const torch::Tensor& photograph)
{
    const LogColours colours(photograph);
    const torch::Tensor &red = colours.red, &green = colours.green, &blue = colours.blue;
    const torch::Tensor contrast = colours.contrast();
    const torch::Tensor deviation = (surroundings(contrast.square()) + leastVariance).sqrt();
    return torch::cat({(contrast / deviation).clamp(-4, 4), deviation.log() + 2.5, (4 * contrast).clamp(-4, 4),
                       4 * againstSurroundings(red - green), 4 * againstSurroundings(blue - green)},
                      1);
}

}  // namespace rendering::models
