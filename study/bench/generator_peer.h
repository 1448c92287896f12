// Times of the generators' networks, in turns with the same networks in Python's torch (python3-torch) and with ours on the
// reference BLAS. Neither is needed by the program.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace study::bench {

struct PeerComparison {
    std::string peer;    ///< "python torch 1.13.0", "ours on the reference BLAS"
    std::string whyNot;  ///< the reason where it could not be compared; there are no numbers then
    std::optional<double> oursTrainMs, theirsTrainMs,
        trainRatio;  ///< medians; the ratio is ours over theirs, its median over the pairs
    std::optional<double> oursInferMs, theirsInferMs, inferRatio;
    std::optional<double> answersApart;  ///< largest difference of the outputs for the same batch and parameters
};

/// Runs `pairs` training steps and `pairs` inferences of each, in turns. Throws environmentFault where vis2hap-nn cannot be
/// started.
std::vector<PeerComparison> compareGeneratorPeers(int pairs = 10);

}  // namespace study::bench
