// The weights file (a torch archive of the two generators) and the model card beside it.
// Included by this folder's torch sources only.
#pragma once

#include <filesystem>
#include <string>

#include "rendering/models/model_card_fields.h"
#include "rendering/models/networks/networks.h"

namespace rendering::models {

struct Generators {
    HeightGenerator height{nullptr};
    FrictionGenerator friction{nullptr};
};

Generators makeGenerators(const Architecture& architecture);

/// Rounds the parameters to half precision, as the file keeps them.
void roundToHalf(Generators& generators);

/// Parameters in half precision, running statistics in single. Fills in the card's SHA-256 and writes
/// both files, each by temporary file, fsync and rename. Throws environmentFault.
void writeModel(const std::filesystem::path& model, Generators& generators, ModelCardFields card);

/// In evaluation mode. Throws badInput for a file that is truncated, of another version, altered
/// since its card was written, or holds numbers that are not finite.
Generators readModel(const std::filesystem::path& model, const ModelCardFields& card);

/// An archive's bytes, whole on disk before the name shows. Throws environmentFault.
void writeArchive(const std::filesystem::path& file, torch::serialize::OutputArchive& archive);
/// Throws badInput where the file is no archive.
torch::serialize::InputArchive readArchive(const std::filesystem::path& file);

}  // namespace rendering::models
