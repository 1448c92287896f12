// A spectrogram as two files: NAME.json with every parameter that the inversion needs, and NAME.npy with the values.
// In Python, numpy.load("NAME.npy").view(complex) gives a complex one.
#pragma once

#include <filesystem>
#include <variant>

#include "protocols/files/whole_file.h"
#include "rendering/signals/spectrogram.h"

namespace rendering {

/// Writes NAME.json and NAME.npy; `file` is NAME.json. The values are 64-bit: magnitudes [frequency x frame], or real and
/// imaginary parts side by side [frequency x 2 frame]. Throws environmentFault.
void writeSpectrogram(const std::filesystem::path& file, const signals::Spectrogram& spectrogram,
                      protocols::Sync sync = protocols::Sync::Now);
void writeSpectrogram(const std::filesystem::path& file, const signals::MagnitudeSpectrogram& spectrogram,
                      protocols::Sync sync = protocols::Sync::Now);

/// Throws badInput naming the file: missing, malformed, or with parameters that cannot be inverted. Other faults: values
/// whose size does not match the parameters, values that are not finite, a negative magnitude.
std::variant<signals::Spectrogram, signals::MagnitudeSpectrogram> readSpectrogram(const std::filesystem::path& file);

}  // namespace rendering
