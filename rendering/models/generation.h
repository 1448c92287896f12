// Asking the trained generators for a photograph's height map and friction spectrogram, without
// linking libtorch: the work is done by the second executable (vis2hap-nn), started when the first
// generated signal is asked for and never else.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rendering/signals/spectrogram.h"

namespace rendering::models {

enum class Quality { Fast, Balanced, Accurate };

struct GenerationOptions {
    std::filesystem::path model;  ///< weights file; empty: the shipped weights
    Quality quality = Quality::Balanced;
    bool height = true;    ///< compute G_h
    bool friction = true;  ///< compute G_s
};

struct PhotographToTouch {
    cv::Mat photograph;                ///< CV_8UC3, RGB, any size
    std::optional<double> mmPerPixel;  ///< unknown: assumedMmPerPixel() of photograph_at_pitch.h is taken
};

/// What is told of a photograph beside its signals.
struct PhotographFacts {
    std::optional<double> distance;  ///< to the nearest photograph trained on (see familiarity.h); none: the card does not tell
    double usualDistance = 0;        ///< 99 % of photographs of known fabrics lie below it
    bool middleOnly = false;         ///< larger than a model takes: its edges were cut off (see photograph_at_pitch.h)
    std::optional<double> assumedMmPerPixel;  ///< where the scale is not known: the pitch that it was taken to have
    bool unfamiliar() const { return distance && *distance > usualDistance; }  ///< what is generated is a guess
    bool operator==(const PhotographFacts&) const = default;
};

struct GeneratedSignals {
    cv::Mat heightMm;  ///< CV_32FC1, >= 0; empty if not asked for
    double heightMmPerPixel = 0;
    cv::Mat spectrogram;        ///< CV_32FC1 [frequency x frame] magnitude; empty if not asked for
    std::vector<double> trace;  ///< istft of the spectrogram (phase by Griffin-Lim), coefficient
    double traceMmPerSample = 0;
    double meanFriction = 0;
    /// What it takes to undo the spectrogram; rate in samples a millimetre.
    signals::SpectrogramParameters spectrogramParameters;
    PhotographFacts photograph;
};

/// In the order of the photographs; each by itself, whatever the others are. Throws environmentFault where libtorch or vis2hap-nn
/// cannot be loaded, badInput for weights that are no model of this program.
std::vector<GeneratedSignals> generate(std::span<const PhotographToTouch> photographs, const GenerationOptions& options);

/// What the weights say of themselves, read without libtorch (the .json beside the weights).
struct ModelCard {
    std::string name;
    std::string sha256;  ///< of the weights file
    bool trainedOnProceduralSet = false;
    std::vector<std::string> trainingSampleHashes;  ///< SHA-256 of every file trained on, sorted
    std::string trainingCommand;
};
ModelCard readModelCard(const std::filesystem::path& model);

/// The shipped weights: beside the executable in an installed tree, else in the source tree.
std::filesystem::path shippedModel();

}  // namespace rendering::models
