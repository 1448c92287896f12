// Speed and accuracy of the generators on this machine: milliseconds per photograph and error of every quality, and the
// memory of inference. No torch in this header.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rendering/models/generation.h"

namespace rendering::models {

struct GeneratorBenchRow {
    Quality quality = Quality::Fast;
    double millisecondsPerPhotograph = 0;      ///< median, for height and friction
    double millisecondsAt128 = 0;              ///< the same for the middle 128 x 128 px of the photographs
    double ratioAt128 = 0;                     ///< to the networks of 0.5.0 in the same turns, median; 0 without their weights
    double heightDeviationFromAccurateMm = 0;  ///< mean absolute deviation
    double frictionDeviationFromAccurate = 0;  ///< relative deviation of the mean friction
    double meanFrictionRelativeError = 0;      ///< against the measured mean of the fabric
    double heightSpreadRelativeError = 0;      ///< error of the standard deviation, against the measured one of the fabric
    /// RMS difference from the known relief of the same place, in percent of its RMS height; mean over 15 procedural fabrics.
    double reliefErrorPercent = 0;
};

struct BenchTable {
    std::string model, dataset;
    int photographs = 0;
    double peakMbAt128 = 0;      ///< peak resident memory after loading the weights and one photograph of 128 x 128 px
    double peakMbAtLargest = 0;  ///< the same after the largest possible photograph, 2048 x 2048 px
    std::vector<GeneratorBenchRow> rows;
};

/// Measures a model. `model` empty: the weights that come with the program. `dataset` empty: a new procedural set of
/// 15 fabrics with one sample each. Throws badInput.
BenchTable benchGenerators(const std::filesystem::path& model, const std::filesystem::path& dataset);

std::string asText(const BenchTable& table);
std::string asJson(const BenchTable& table);  ///< {"schema":"vis2hap.bench-generation/1",..}
void writeBench(const std::filesystem::path& file, const BenchTable& table);

}  // namespace rendering::models
