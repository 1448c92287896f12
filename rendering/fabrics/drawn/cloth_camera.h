// A photograph of a drawn fabric. Lamps may stand on any side; the cloth shades itself, casts shadows, and its fibres mirror
// light across their direction (Kajiya-Kay). The camera adds uneven light, white balance, exposure, a tone curve, blur, noise,
// sharpening and JPEG. A `flat` picture has the light taken out, as the colour of published scans: only hollows stay dark.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "protocols/random.h"
#include "rendering/fabrics/drawn/cloth_window.h"

namespace rendering::fabrics {

struct ClothLamp {
    double azimuthDegrees = 225;   ///< from x to y; the light comes from there
    double elevationDegrees = 45;  ///< above the cloth, 8 to 85
    double strength = 1;
    double distance = 8;  ///< in widths of the picture, 1 to 30: a near lamp is uneven
    float tint[3] = {1, 1, 1};
    double softness = 0.3;  ///< 0 for a point to 1 for a broad window
};

struct ClothCamera {
    bool isFlat = false;
    std::vector<ClothLamp> lamps;  ///< 1 to 4
    double ambient = 0.3;          ///< light from everywhere, against the sum of the lamps
    double occlusion = 0.6;        ///< darkening of hollows, 0 to 1.5
    double glow = 0.3;             ///< share of light that spreads within the yarns
    double gloss = 1;              ///< factor of the fabric's sheen
    double exposure = 1;           ///< factor of a correct exposure
    float whiteBalance[3] = {1, 1, 1};
    double gamma = 2.2;     ///< 1.7 to 2.6
    double contrast = 0;    ///< of the tone curve, -0.3 to 0.5
    double vignetting = 0;  ///< loss of light in the corners, 0 to 0.5
    double defocusPx = 0.5, motionPx = 0, motionDegrees = 0;
    double photonNoise = 0.01, readNoise = 0.003;
    double sharpening = 0;
    int jpegQuality = 0;  ///< 30 to 98; 0 for no compression
};

/// Draws a camera and its lamps. `isFlat` for the colour of a scan. Every side of a lamp occurs, but half of the lamps stand at
/// the upper left and low, as people place them. A quarter of the pictures is lit by distant lamps alone, without a sky, as
/// scans are relit.
ClothCamera drawCamera(bool isFlat, protocols::Random& random);

/// Side from which the light of a single lamp comes, degrees in 0 to 360: 0 right, 90 top, anticlockwise. nullopt for a flat
/// picture and for several lamps.
std::optional<double> lightSide(const ClothCamera& camera);

/// Picture and height that lie on each other pixel by pixel.
struct ClothPhotograph {
    cv::Mat rgb;       ///< CV_8UC3, sRGB, red first
    cv::Mat heightMm;  ///< CV_32FC1, mean over the area of the pixel
    double textureSqMm = 0;
};

/// Photographs `size` pixels of `mmPerPixel` around `place`. `random` draws the noise only.
ClothPhotograph photographCloth(const DrawnFabric& fabric, const FabricPlace& place, cv::Size size, double mmPerPixel,
                                const ClothCamera& camera, protocols::Random& random);

/// A window of other cloth, such as a scan: its height (CV_32FC1) and linear reflectance (CV_32FC3), without fibres that mirror.
ClothWindow windowOf(const cv::Mat& heightMm, const cv::Mat& reflectance);

/// Photographs a window at its own pitch, without `border` pixels on every side, of which blur and shadows need some.
ClothPhotograph photographWindow(const ClothWindow& window, double mmPerPixel, int border, const ClothCamera& camera,
                                 protocols::Random& random);

}  // namespace rendering::fabrics
