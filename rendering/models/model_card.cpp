#include "rendering/models/model_card.h"

#include "protocols/shipped_folder.h"
#include "rendering/models/model_card_fields.h"

namespace rendering::models {

ModelCard readModelCard(const std::filesystem::path& model) { return readModelCardFields(model).summary; }

std::filesystem::path shippedModel()
{
    return protocols::shippedFolder("weights", VIS2HAP_SOURCE_DIR "/rendering/models/weights") / "vis2hap.safetensors";
}

std::filesystem::path earlierModel() { return shippedModel().parent_path() / "version-0.5.0.safetensors"; }

}  // namespace rendering::models
