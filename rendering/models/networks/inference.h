// Photographs through the trained generators: the work of vis2hap-nn. No torch in this header.
#pragma once

#include <filesystem>
#include <memory>

#include "rendering/models/generation.h"

namespace rendering::models {

class LoadedModel {
public:
    /// Throws badInput for weights that are no model of this program. `threads` 0: all of the machine's.
    explicit LoadedModel(const std::filesystem::path& model, int threads = 0);
    ~LoadedModel();

    /// The height map covers the photograph as photographAtPitch gives it. Quality: fast takes one pass of G_h without margin and
    /// one crop of G_s, balanced two passes (as it is and turned by 180 degrees) and four crops, accurate eight passes (all turns
    /// and mirrorings of the square) and nine crops in four mirrorings; passes and crops are averaged. The spectrum is imposed
    /// in 1, 3 and 6 rounds, the trace's phases are sought in 8, 32 and 200.
    GeneratedSignals generate(const InputPhotograph& photograph, const GenerationOptions& options) const;

private:
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

}  // namespace rendering::models
