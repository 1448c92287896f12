// The second executable, vis2hap-nn, which alone links libtorch.
#pragma once

#include <string>
#include <vector>

namespace rendering::models {

/// Its path: beside this program, or what VIS2HAP_NN names.
std::string secondProgram();

/// Runs `vis2hap-nn ARGUMENTS...` on this terminal and returns its exit code. Throws environmentFault
/// where it, or the libtorch that it needs, is not there.
int runSecondProgram(const std::vector<std::string>& arguments);

/// Its standard output. Throws environmentFault as above, workFailed where it fails.
std::string outputOfSecondProgram(const std::vector<std::string>& arguments);

}  // namespace rendering::models
