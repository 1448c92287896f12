// A spectrogram as two files: NAME.json with every parameter that it takes to undo it, and NAME.npy beside it
// with its values. In Python: numpy.load("NAME.npy").view(complex) for a complex one.
#pragma once

#include <filesystem>
#include <variant>

#include "protocols/files/whole_file.h"
#include "rendering/signals/spectrogram.h"

namespace rendering {

/// `file`: NAME.json. The values are 64-bit, [frequency x frame] magnitudes or [frequency x 2 frame] with real and
/// imaginary parts side by side. Throws environmentFault.
void writeSpectrogram(const std::filesystem::path& file, const signals::Spectrogram& spectrogram,
                      protocols::Sync sync = protocols::Sync::Now);
void writeSpectrogram(const std::filesystem::path& file, const signals::MagnitudeSpectrogram& spectrogram,
                      protocols::Sync sync = protocols::Sync::Now);

/// Throws badInput naming the file: missing, malformed, parameters that cannot be undone, values of another size
/// than the parameters say, not finite, or a negative magnitude.
std::variant<signals::Spectrogram, signals::MagnitudeSpectrogram> readSpectrogram(const std::filesystem::path& file);

}  // namespace rendering
