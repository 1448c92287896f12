// Our side of `bench generators --peers`: the networks as they are, trained and asked on fixed random
// batches, one order at a time, so that another program with the same networks can be timed in turns.
// No torch in this header.
#pragma once

#include <filesystem>
#include <istream>
#include <ostream>

namespace rendering::models {

/// Writes FOLDER/peer.pt: all parameters and buffers ("height.", "friction.", "discriminator."), the
/// batch and what the untrained networks answer to it; says "ready SIZES..." on `out`. Then answers a
/// line each on `in`: "train" and "infer" with milliseconds, "losses" with both losses of the last
/// step; anything else ends it. A training step: hinge losses of the discriminator, then adversarial
/// and L1 losses of both generators, Adam; 8 photographs of 128 px. Inference: one photograph of 128 px
/// through both generators; the median of five.
void servePeerSteps(const std::filesystem::path& folder, std::istream& in, std::ostream& out);

}  // namespace rendering::models
