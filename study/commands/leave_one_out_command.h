// vis2hap train DATASET --leave-one-out: a training without each fabric in turn, and its test on this fabric.
#pragma once

#include <string>
#include <vector>

#include "study/commands/parts/shard_option.h"

namespace study::commands {

struct LeaveOneOutCall {
    std::string dataset, folder;         ///< the models are FOLDER/F01.safetensors, …
    std::vector<std::string> arguments;  ///< options of every training; without --out, --hold-out, --threads and --resume
    unsigned threads = 0;                ///< 0: as many as the machine has
    bool resume = false;                 ///< keep finished models, and continue interrupted trainings
    ShardOption shard;
    JsonTarget target;
};

/// Trains and tests the fabrics of the shard, or all.
int leaveOneOut(const LeaveOneOutCall& call);

}  // namespace study::commands
