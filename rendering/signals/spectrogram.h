// Spectrogram of a friction trace (centred short-time Fourier transform) and its inversion. The complex spectrogram is
// inverted exactly; the magnitude alone is inverted by Griffin-Lim, with the mean stored beside it.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace rendering::signals {

/// Parameters that are stored with every spectrogram. The window is a periodic Hann window, centred in the transform where
/// the transform is longer.
struct SpectrogramParameters {
    int windowLength = 64;
    int hop = 16;
    int fftSize = 64;
    double sampleRateHz = 60;

    int frequencies() const { return fftSize / 2 + 1; }
    int frames(int traceLength) const { return 1 + traceLength / hop; }  ///< frame i is centred on sample i * hop
    bool operator==(const SpectrogramParameters&) const = default;
};

struct Spectrogram {
    SpectrogramParameters parameters;
    int traceLength = 0;  ///< number of samples
    double mean = 0;      ///< mean of the trace
    cv::Mat values;       ///< CV_64FC2 [frequency x frame], not normalised
};

struct MagnitudeSpectrogram {
    SpectrogramParameters parameters;
    int traceLength = 0;
    double mean = 0;  ///< mean of the trace; an inversion has exactly this mean
    cv::Mat values;   ///< CV_64FC1 or CV_32FC1 [frequency x frame], >= 0
};

/// Throws badInput where the windows do not satisfy constant overlap-add to 0.1 %. Then a mean read from the row of
/// frequency 0 would weight some samples more than others.
void requireConstantOverlap(const SpectrogramParameters& parameters);

/// Throws badInput where the transform cannot be inverted. Reasons: a sample without a window (hop too long), a window
/// longer than the transform, a window shorter than 2.
void requireInvertible(const SpectrogramParameters& parameters);

/// Short-time Fourier transform. The trace is mirrored about its first and last sample where a window reaches beyond it.
/// Throws badInput for fewer than two samples, a value that is not finite, or parameters that cannot be inverted.
Spectrogram stft(std::span<const double> trace, const SpectrogramParameters& parameters = {});

/// Overlap-add weighted by the window and divided by the sum of the squared windows. Exact for the spectrogram of a trace;
/// the least-squares solution for others (Griffin & Lim 1984, eq. 6).
std::vector<double> istft(const Spectrogram& spectrogram);

MagnitudeSpectrogram magnitude(const Spectrogram& spectrogram);

/// Mean of a trace, read from the row of frequency 0; the trace must be positive throughout. Throws badInput like
/// requireConstantOverlap().
double meanFromMagnitude(const cv::Mat& values, const SpectrogramParameters& parameters);

enum class InversionQuality { Fast, Accurate };

struct GriffinLimOptions {
    std::uint64_t seed = 1;  ///< seed for the initial phases
    int iterations = 32;
    double momentum = 0.99;  ///< Perraudin, Balazs & Sondergaard 2013; 0 gives the plain algorithm

    static GriffinLimOptions of(InversionQuality quality);
};

struct Inversion {
    std::vector<double> trace;
    /// |STFT(trace)| against the requested magnitude, relative, over the rows from 2 on. The mean affects the rows below, and
    /// it is so large that with them every result would look perfect.
    double spectralConvergence = 0;
    /// The same for the trace before each iteration; empty for 0 iterations.
    std::vector<double> convergence;
};

/// Finds a trace with the given magnitude and mean. The row of frequency 0 keeps phase 0, because friction is positive.
/// Throws badInput where the magnitude has the wrong size, is negative or is not finite.
Inversion griffinLim(const MagnitudeSpectrogram& spectrogram, const GriffinLimOptions& options = {});

}  // namespace rendering::signals
