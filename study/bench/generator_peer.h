// The generators' networks timed in turns with the same networks elsewhere: in Debian's Python torch
// (python3-torch), and in ours on the reference BLAS. Peers only; nothing of ours needs them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace study::bench {

struct PeerComparison {
    std::string peer;                                              ///< "python torch 1.13.0", "ours on the reference BLAS"
    std::string whyNot;                                            ///< where it could not be compared; the numbers are empty then
    std::optional<double> oursTrainMs, theirsTrainMs, trainRatio;  ///< medians; ours over theirs, median of the pairs
    std::optional<double> oursInferMs, theirsInferMs, inferRatio;
    std::optional<double> answersApart;  ///< largest difference of any answer to the same batch with the same parameters
};

/// `pairs` of a training step and of inference each, in turns. Throws environmentFault where vis2hap-nn cannot be started.
std::vector<PeerComparison> compareGeneratorPeers(int pairs = 10);

}  // namespace study::bench
