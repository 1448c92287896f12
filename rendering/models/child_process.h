// Starting vis2hap-nn and telling what became of it in this program's own words.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rendering::models {

/// What libtorch's libraries read from the environment when they load, as name and value, where the user has not chosen
/// otherwise. OpenMP's threads wait by spinning for milliseconds unless told otherwise, which on a busy machine makes two
/// threads many times slower than one; without any spinning, waking them takes as long as the small steps of one photograph.
/// OpenBLAS's own threads would spin beside them and have next to nothing to do.
std::vector<std::pair<std::string, std::string>> missingThreadSettings();

/// Beside the running executable, or one folder above it (tests); the environment variable VIS2HAP_NN
/// overrides. Throws environmentFault where it is not there.
std::filesystem::path generatorProgram();

/// Runs it to its end, its output going into the file `messages`. Its own error line is thrown again
/// with its exit code (badInput, workFailed, environmentFault); a program that the loader cannot start
/// (libtorch is missing) or that a signal ended is an environmentFault.
void runGeneratorProgram(const std::vector<std::string>& arguments, const std::filesystem::path& messages);

}  // namespace rendering::models
