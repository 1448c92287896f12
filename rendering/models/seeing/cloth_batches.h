// Batches of cloth whose relief is known pixel by pixel: drawn fabrics, made when they are needed and never shown twice, and
// scanned fabrics, as they are or photographed anew by the simulated camera. No torch here.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/architecture.h"

namespace rendering::models {

/// A picture of scanned cloth.
struct ScannedCloth {
    std::string fabric;
    cv::Mat rgb;       ///< CV_8UC3, sRGB
    cv::Mat heightMm;  ///< CV_32FC1 of the same size
    double mmPerPixel = 0.2;
    bool isFlat = false;                  ///< plain colour, with the light taken out: the simulated camera can photograph it anew
    std::optional<double> lightDeg = {};  ///< side of a single lamp (told_lamp.h)
    std::string sha256 = {};              ///< of the file of the picture
};

/// Pictures of a data set: fabric and index.
using PictureSet = std::set<std::pair<protocols::FabricId, int>>;

/// All pictures of a data set that have a scale and a surface in mm. Fabrics of `heldOut` and pictures of `leftOut` are left out.
/// Throws badInput where no picture with light "colour" remains. Throws it, too, for a surface of another size than its picture,
/// or with gaps.
std::vector<ScannedCloth> readScannedCloth(const fabrics::Dataset& dataset, const std::vector<protocols::FabricId>& heldOut,
                                           const PictureSet& leftOut = {});

/// SHA-256 of the file of each picture, in their order.
std::vector<std::string> hashesOf(const std::vector<ScannedCloth>& scans);

/// In the layout of the networks (N x C x H x W, row-major).
struct ClothBatch {
    int size = 0, side = 0;
    std::vector<float> photographs;  ///< [N, 3, side, side], 0 to 1
    std::vector<float> reliefs;      ///< [N, 1, side, side], pixels
    std::vector<float> logPitches;   ///< [N, 1]: logarithm of mm a pixel over pitchUnitMm (seeing_networks.h)
    std::vector<float> lamps;        ///< [N, 2] (told_lamp.h)
    std::vector<float>
        logFrictions;  ///< [N, 1]: logarithm of the mean coefficient; NaN for scans, whose friction nobody measured
    std::vector<std::optional<fabrics::Fibre>> fibres;  ///< N; nullopt for scans
    std::vector<float> logRatios;  ///< [N, 1, rows, frames] of a stroke at another place (friction_target.h); NaN for scans
};

/// Writes a picture CV_8UC3 as [3, rows, columns], 0 to 1.
void copyPhotograph(const cv::Mat& rgb, float* out);

struct ClothBatchOptions {
    int size = 8;
    int side = 128;                  ///< px, a multiple of 16
    double scanShare = 0.3;          ///< share of scanned cloth, where there is any
    double flatShare = 0.3;          ///< share of pictures with the light taken out, as published scans are
    double toldShare = 0.6;          ///< share of the pictures with one lamp whose side is told
    double anewShare = 0.4;          ///< share of scanned cloth that is photographed anew
    Architecture spectrograms = {};  ///< of the strokes
    int firstRow = 0;                ///< of the patches that are drawn
    std::optional<int> rows = {};    ///< number of them; nullopt: all from firstRow on
};

/// Rows of batch `number` of the family `seed`; equal arguments give equal rows, whichever rows are drawn beside them. Drawn
/// fabric `number` x size + i appears in it only.
ClothBatch drawClothBatch(const std::vector<ScannedCloth>& scans, const ClothBatchOptions& options, std::uint64_t seed,
                          std::uint64_t number);

}  // namespace rendering::models
