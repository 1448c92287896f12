// Sizes of the networks and units of their inputs and outputs. The model card stores them, so that weights of another
// program version are refused with a clear message.
#pragma once

#include "rendering/models/told_fibre.h"

namespace rendering::models {

/// Upper bounds that keep the memory of training, and of reading a card, within reason.
inline constexpr int largestCrop = 512, mostChannels = 256;

struct Architecture {
    /// True: the networks of rendering/models/seeing, which work at any pitch; then mmPerPixel, heightScaleMm,
    /// meanFrictionScale, imposesSpectrum and zeroPercentile have no meaning.
    bool sees = false;
    int baseChannels = 16;      ///< channels of G_h at full resolution; the other layers have multiples of it
    int frictionChannels = 16;  ///< of the friction network that sees
    int crop = 128;             ///< side in px of a training crop, and of the photograph that G_s takes; a multiple of 16
    int window = 64;            ///< samples in a window of the short-time Fourier transform
    int hop = 16;               ///< samples between windows
    int traceSamples = 480;     ///< 40 mm at 5 mm/s and 60 Hz
    int rows = 33;              ///< frequencies of the spectrogram
    int frames = 31;
    double mmPerPixel = 0.05;  ///< pitch of the photographs and heights in the networks
    double traceMmPerSample = 5.0 / 60.0;
    double heightScaleMm = 0.1;      ///< millimetres per unit of G_h's output
    double meanFrictionScale = 0.5;  ///< coefficient per unit of G_s's mean, before its last non-linearity
    bool imposesSpectrum = true;     ///< the relief gets the predicted or known radial power spectrum (ring_spectrum.h)
    double zeroPercentile = 2;       ///< percent of a measured map at or below 0; also of a relief with imposed spectrum
    /// Factor of the deviation of friction that networks that see state. With it, the 90 % interval held 90 % of the drawn
    /// fabrics of a family of its own.
    double intervalFactor = 1;
    /// What a laboratory measured over what networks that see generate (lab/lab_training.h): its rig and its sensor have their
    /// own scales. Friction and relief are multiplied with them.
    double frictionFactor = 1, reliefFactor = 1;
    FibreReadings fibres = {};
    bool operator==(const Architecture&) const = default;
};

}  // namespace rendering::models
