#include "rendering/models/model_card.h"

#include "rendering/models/model_card_fields.h"

namespace rendering::models {

ModelCard readModelCard(const std::filesystem::path& model) { return readModelCardFields(model).summary; }

std::filesystem::path shippedModel()
{
    std::error_code none;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", none);
    if (!none) {
        const std::filesystem::path beside = self.parent_path() / "weights" / "vis2hap.safetensors";
        if (std::filesystem::exists(beside, none)) return beside;
    }
    return std::filesystem::path(VIS2HAP_SOURCE_DIR) / "rendering" / "models" / "weights" / "vis2hap.safetensors";
}

std::filesystem::path earlierModel() { return shippedModel().parent_path() / "version-0.5.0.safetensors"; }

}  // namespace rendering::models
