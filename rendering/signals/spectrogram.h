// A friction trace as a spectrogram (centred short-time Fourier transform) and back: exactly from the
// complex one, and from its magnitude alone by Griffin-Lim, with the mean carried beside it.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace rendering::signals {

/// Stored with every spectrogram. The window is a periodic Hann window, in the middle of the transform
/// where that is longer.
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
    int traceLength = 0;  ///< samples
    double mean = 0;      ///< of the trace
    cv::Mat values;       ///< CV_64FC2 [frequency x frame], unnormalised
};

struct MagnitudeSpectrogram {
    SpectrogramParameters parameters;
    int traceLength = 0;
    double mean = 0;  ///< of the trace; an inversion has exactly this mean
    cv::Mat values;   ///< CV_64FC1 or CV_32FC1 [frequency x frame], >= 0
};

/// Throws badInput where the windows do not add up to the same everywhere (constant overlap-add, to 0.1 %):
/// a mean read from the row of frequency 0 would weigh some samples more than others.
void requireConstantOverlap(const SpectrogramParameters& parameters);

/// Throws badInput where the window cannot be undone: a sample that no window weighs (hop too long),
/// a window longer than the transform, or a length below 2.
void requireInvertible(const SpectrogramParameters& parameters);

/// The trace is mirrored about its first and last sample where a window reaches over the ends. Throws
/// badInput for fewer than two samples, a value that is not finite, or parameters that cannot be undone.
Spectrogram stft(std::span<const double> trace, const SpectrogramParameters& parameters = {});

/// Overlap-add weighted by the window and divided by the sum of its squares: the exact inverse, and the
/// least-squares one for a spectrogram that no trace has (Griffin & Lim 1984, eq. 6).
std::vector<double> istft(const Spectrogram& spectrogram);

MagnitudeSpectrogram magnitude(const Spectrogram& spectrogram);

/// The mean as the row of frequency 0 tells it, for a trace that is positive throughout. Throws badInput as
/// requireConstantOverlap().
double meanFromMagnitude(const cv::Mat& values, const SpectrogramParameters& parameters);

enum class InversionQuality { Fast, Accurate };

struct GriffinLimOptions {
    std::uint64_t seed = 1;  ///< of the first guess of the phases
    int iterations = 32;
    double momentum = 0.99;  ///< Perraudin, Balazs & Sondergaard 2013; 0: the plain algorithm

    static GriffinLimOptions of(InversionQuality quality);
};

struct Inversion {
    std::vector<double> trace;
    /// |STFT(trace)| against the magnitude asked for, relative, over the rows that the mean does not
    /// reach (from 2 on): the mean is so large that with it every result would look perfect.
    double spectralConvergence = 0;
    /// The same before each iteration, of the trace it starts from: how it converged. Empty for 0 iterations.
    std::vector<double> convergence;
};

/// A trace with the given magnitude and mean. The row of frequency 0 keeps phase 0, since friction is
/// positive. Throws badInput where the magnitude has the wrong size, is negative or not finite.
Inversion griffinLim(const MagnitudeSpectrogram& spectrogram, const GriffinLimOptions& options = {});

}  // namespace rendering::signals
