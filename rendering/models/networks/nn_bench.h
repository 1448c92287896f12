// The speed-accuracy table of the generators on this machine: milliseconds a photograph and the error
// of every quality, and the memory that inference takes. No torch in this header.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rendering/models/generation.h"

namespace rendering::models {

struct BenchRow {
    Quality quality = Quality::Fast;
    double millisecondsPerPhotograph = 0;      ///< median, height and friction
    double millisecondsAt128 = 0;              ///< the same of the photographs' middle 128 x 128 px
    double heightDeviationFromAccurateMm = 0;  ///< mean absolute
    double frictionDeviationFromAccurate = 0;  ///< of the mean, relative
    double meanFrictionRelativeError = 0;      ///< against the fabric's measured mean
    double heightSpreadRelativeError = 0;      ///< standard deviation against the fabric's measured one
};

struct BenchTable {
    std::string model, dataset;
    int photographs = 0;
    double peakMbAt128 = 0;      ///< most memory ever resident, weights loaded and one photograph of 128 x 128 px done
    double peakMbAtLargest = 0;  ///< the same after the largest photograph that is taken, 2048 x 2048 px
    std::vector<BenchRow> rows;
};

/// `model` empty: the shipped weights. `dataset` empty: a procedural set of 15 fabrics, one sample
/// each, made for it. Throws badInput.
BenchTable benchGenerators(const std::filesystem::path& model, const std::filesystem::path& dataset);

std::string asText(const BenchTable& table);
std::string asJson(const BenchTable& table);  ///< {"schema":"vis2hap.bench-generation/1",...}
void writeBench(const std::filesystem::path& file, const BenchTable& table);

}  // namespace rendering::models
