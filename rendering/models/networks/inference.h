// Inference: photographs through the trained generators, for vis2hap-nn. No torch in this header.
#pragma once

#include <filesystem>
#include <memory>

#include "rendering/models/generation.h"

namespace rendering::models {

class LoadedModel {
public:
    /// Throws badInput for weights that this program cannot use. `threads` 0: all threads of the machine.
    explicit LoadedModel(const std::filesystem::path& model, int threads = 0);
    ~LoadedModel();

    /// Signals of a photograph; the height map covers the part that photographAtPitch() returns.
    /// Fast: one pass of G_h without margin, one crop of G_s. Balanced: two passes (as it is and rotated by 180 degrees), four
    /// crops. Accurate: eight passes (all symmetries of the square), nine crops in four mirrorings. Passes and crops are
    /// averaged. The spectrum is imposed in 1, 3 or 6 passes; Griffin-Lim takes 8, 32 or 200 iterations.
    GeneratedSignals generate(const InputPhotograph& photograph, const GenerationOptions& options) const;

private:
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

}  // namespace rendering::models
