// Starting vis2hap-nn and telling what became of it in this program's own words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rendering::models {

/// Beside the running executable, or one folder above it (tests); the environment variable VIS2HAP_NN
/// overrides. Throws environmentFault where it is not there.
std::filesystem::path generatorProgram();

/// Runs it to its end, its output going into the file `messages`. Its own error line is thrown again
/// with its exit code (badInput, workFailed, environmentFault); a program that the loader cannot start
/// (libtorch is missing) or that a signal ended is an environmentFault.
void runGeneratorProgram(const std::vector<std::string>& arguments, const std::filesystem::path& messages);

}  // namespace rendering::models
