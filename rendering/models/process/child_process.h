// Starts vis2hap-nn and turns its failures into errors of this program.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "rendering/models/process/limited_process.h"

namespace rendering::models {

/// Thread settings (name and value) that libtorch's libraries read from the environment when they load, without those that
/// the user has set. By default OpenMP's idle threads spin for milliseconds, so on a busy machine two threads are many times
/// slower than one. Without any spinning, waking them takes as long as the small steps of one photograph. OpenBLAS's own
/// threads would spin beside them and have almost no work.
std::vector<std::pair<std::string, std::string>> missingThreadSettings();

/// Path beside the running executable or one folder above it (tests); the environment variable VIS2HAP_NN overrides it.
/// Throws environmentFault where the program does not exist.
std::filesystem::path generatorProgram();

/// Runs the program to its end, within `limits`; its output goes into the file `messages`. Throws its error line with its exit
/// code (badInput, workFailed, environmentFault). Throws environmentFault where the loader cannot start it (libtorch is missing),
/// a signal ends it, or it does not finish in time.
void runGeneratorProgram(const std::vector<std::string>& arguments, const std::filesystem::path& messages,
                         const ProcessLimits& limits);

}  // namespace rendering::models
