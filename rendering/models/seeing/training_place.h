// The place of this process among those that train one model together. No torch in this header.
#pragma once

#include <string>

namespace rendering::models {

/// Most processes of a training.
inline constexpr int mostProcesses = 64;

struct TrainingPlace {
    int processes = 1;
    int rank = 0;        ///< 0 to processes - 1; rank 0 validates, reports and writes all files
    std::string master;  ///< HOST:PORT where rank 0 waits for the others; unused where there is one process
    int waitS = 600;     ///< longest wait for the other processes, s

    bool isAlone() const { return processes == 1; }
    bool isFirst() const { return rank == 0; }
};

}  // namespace rendering::models
