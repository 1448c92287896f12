// Our side of `bench generators --peers`: training and inference of the networks on fixed random batches. Each order runs
// one of them, so that another program with the same networks can be timed in turns. No torch in this header.
#pragma once

#include <filesystem>
#include <istream>
#include <ostream>

namespace rendering::models {

/// Writes FOLDER/peer.safetensors: all parameters and buffers ("height.", "friction.", "discriminator."), the batch, and the
/// outputs of the untrained networks for it. Prints "ready SIZES" with the sizes on `out`. Then answers each line of `in` with a
/// line: "train" and "infer" with milliseconds, "losses" with both losses of the last step. Anything else ends it.
/// A training step: hinge loss of the discriminator, then adversarial and L1 losses of both generators, Adam; 8 photographs
/// of 128 px. Inference: one photograph of 128 px through both generators; the median of five.
void servePeerSteps(const std::filesystem::path& folder, std::istream& in, std::ostream& out);

}  // namespace rendering::models
