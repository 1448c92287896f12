// The file of a stimulus in the folder of a study: sealed with the station key and bound to its name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "protocols/ids.h"
#include "protocols/secrets/secret_key.h"

namespace protocols {

/// stimuli/<code>.sealed
std::filesystem::path stimulusFile(const std::filesystem::path& stimuli, const FileCode& code);

/// Writes the sealed file (mode 0600) with a time stamp that all stimuli share, and returns its SHA-256. The bytes reach the disk
/// with the study folder, which is synced as a whole. `pgm`: bytes of the image, of equal length in one study.
std::string writeSealedStimulus(const std::filesystem::path& stimuli, const FileCode& code, std::string_view pgm,
                                const SecretKey& stationKey);

}  // namespace protocols
