// Runs the second executable, vis2hap-nn, for commands; only it links libtorch.
#pragma once

#include <string>
#include <vector>

namespace rendering::models {

/// Path of vis2hap-nn, as generatorProgram() finds it. Throws environmentFault where the program does not exist.
std::string secondProgram();

/// Runs `vis2hap-nn ARGUMENTS...` on this terminal and returns its exit code. Throws environmentFault where vis2hap-nn or
/// libtorch is missing.
int runSecondProgram(const std::vector<std::string>& arguments);

/// Runs it with a file name after the last argument, such as `--json FILE`, and returns what it wrote into this file. Throws
/// environmentFault as above or where it takes more than an hour, workFailed where the program fails.
std::string outputOfSecondProgram(std::vector<std::string> arguments);

}  // namespace rendering::models
