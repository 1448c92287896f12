// The numbers that fix the shape of the networks and the units of what they speak; stored in the
// model card, so that weights and program agree or part with a clear message.
#pragma once

namespace rendering::models {

/// Beyond them neither the memory of a training nor that of a card's reader is answered for.
inline constexpr int largestCrop = 512, mostChannels = 256;

struct Architecture {
    int baseChannels = 16;   ///< channels of G_h at full resolution; the others are multiples
    int crop = 128;          ///< side of a training crop and of the photograph that G_s takes, px, multiple of 16
    int window = 64;         ///< of the short-time Fourier transform, samples
    int hop = 16;            ///< samples
    int traceSamples = 480;  ///< 40 mm at 5 mm/s and 60 Hz
    int rows = 33;           ///< frequencies of the spectrogram
    int frames = 31;
    double mmPerPixel = 0.05;  ///< pitch of photographs and heights as the networks see them
    double traceMmPerSample = 5.0 / 60.0;
    double heightScaleMm = 0.1;      ///< one unit of G_h's output
    double meanFrictionScale = 0.5;  ///< one unit of G_s's mean before its last non-linearity
    bool imposesSpectrum = true;     ///< the relief is brought to the predicted or remembered radial spectrum (ring_spectrum.h)
    double zeroPercentile = 2;       ///< percent of a measured map that lies at 0; a relief's, too, where the spectrum is imposed
    bool operator==(const Architecture&) const = default;
};

}  // namespace rendering::models
