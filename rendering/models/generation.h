// Height maps and friction spectrograms from photographs by the trained generators, without linking libtorch. A second
// executable, vis2hap-nn, does the work; it starts only when a generated signal is needed.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "protocols/quality.h"
#include "rendering/fabrics/fibre.h"
#include "rendering/models/model_card.h"
#include "rendering/signals/spectrogram.h"

namespace rendering::models {

using protocols::Quality;

struct GenerationOptions {
    std::filesystem::path model;  ///< weights file; empty: the weights that come with the program
    Quality quality = Quality::Balanced;
    bool height = true;    ///< compute G_h
    bool friction = true;  ///< compute G_s
};

struct InputPhotograph {
    cv::Mat photograph;                ///< CV_8UC3, RGB, any size
    std::optional<double> mmPerPixel;  ///< nullopt: assumedMmPerPixel() of photograph_at_pitch.h is used
    /// Side from which a single lamp lights the cloth, degrees: 0 right, 90 top, anticlockwise. nullopt: nobody knows.
    std::optional<double> lightDeg = {};
    std::optional<fabrics::Fibre> fibre = {};  ///< told_fibre.h; nullopt: nobody knows
};

/// 90 % interval of a mean coefficient of friction, as the networks judge a photograph. Never checked on fabrics whose measured
/// friction they had not seen.
struct FrictionInterval {
    double low = 0, high = 0;
    /// The interval of an ordinary cloth that nobody has looked at spans a factor of four and more.
    bool tellsLittle() const { return high > 2.5 * low; }
    bool operator==(const FrictionInterval&) const = default;
};

/// Information on a photograph besides its signals.
struct PhotographFacts {
    bool middleOnly = false;  ///< the photograph was too large, so only its middle was used (photograph_at_pitch.h)
    std::optional<double> assumedMmPerPixel = {};       ///< the assumed pitch, where the scale is unknown
    std::optional<FrictionInterval> meanFriction = {};  ///< nullopt where friction was not asked for, or the networks give none
    bool operator==(const PhotographFacts&) const = default;
};

struct GeneratedSignals {
    cv::Mat heightMm;  ///< CV_32FC1, >= 0; empty if not requested
    double heightMmPerPixel = 0;
    cv::Mat spectrogram;        ///< CV_32FC1 [frequency x frame], magnitude; empty if not requested
    std::vector<double> trace;  ///< coefficient: inverse of the spectrogram, with phases from Griffin-Lim
    double traceMmPerSample = 0;
    double meanFriction = 0;
    /// Parameters for the inversion of the spectrogram; its sample rate is in samples per millimetre.
    signals::SpectrogramParameters spectrogramParameters;
    PhotographFacts photograph;
    /// Time that the networks and the steps after them took, without starting the program and loading weights; 0 if not
    /// requested.
    double heightMilliseconds = 0, frictionMilliseconds = 0;
};

/// Signals in the order of the photographs. Each photograph is processed independently of the others. Throws environmentFault
/// where libtorch or vis2hap-nn cannot be loaded, badInput for weights that this program cannot use.
std::vector<GeneratedSignals> generate(std::span<const InputPhotograph> photographs, const GenerationOptions& options);

}  // namespace rendering::models
