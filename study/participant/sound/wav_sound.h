// Recordings: WAV files with PCM samples of 16 bits, one or two channels, as mono sound at the rate of the mix.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace study::participant {

inline constexpr int mixRateHz = 48000;
inline constexpr std::size_t largestWav = std::size_t{32} << 20;  ///< bytes, about three minutes of stereo

/// Samples from -1 to 1 at mixRateHz. Throws badInput for anything but PCM of 16 bits with one or two channels at 8 to 192 kHz,
/// for a file without samples, and for a cut one. `where` names the file in errors.
std::vector<float> soundFromWav(std::string_view bytes, const std::string& where);

/// The same sound as a WAV file of 16 bits. Samples beyond -1 to 1 are clipped.
std::string wavOf(const std::vector<float>& samples);

}  // namespace study::participant
