// Upper bounds of what a call of a training may ask for, so that it ends with a message and not for want of memory or threads.
#pragma once

#include <string>

#include "protocols/files/errors.h"

namespace rendering::models {

inline constexpr int mostInBatch = 1024, mostThreads = 1024;
inline constexpr double largestRate = 1e30;  ///< beyond it a step is no number of 32 bits; a loss stops far below

/// Throws badInput for a batch, a learning rate or a number of threads above its bound.
inline void requireWithinLimits(int batch, double learningRate, int threads)
{
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw protocols::badInput({what, "train", expected, "correct the option"});
    };
    if (batch > mostInBatch) refuse("--batch is " + std::to_string(batch), "at most " + std::to_string(mostInBatch));
    if (threads > mostThreads) refuse("--threads is " + std::to_string(threads), "at most " + std::to_string(mostThreads));
    if (learningRate > largestRate) refuse("--learning-rate is above 1e30", "a rate such as 0.001");
}

}  // namespace rendering::models
