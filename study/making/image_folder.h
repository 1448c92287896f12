// Friction images kept by name beside a study that people made themselves (`study new --images`), so
// that they can be looked at and need not be made twice. Reused only where everything they follow
// from, and every file's hash, is the same.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "rendering/composition/render_fabrics.h"

namespace study::making {

struct KeptImages {
    std::map<protocols::ConditionId, std::map<protocols::FabricId, cv::Mat>> images;
    std::string signalsJson;
    std::vector<std::string> stamps;  ///< sentences on the images that a report must carry
};

/// SHA-256 over all that the images follow from: data set, fabrics, samples, conditions, weights, program.
std::string imageFolderKey(const database::StudyFacts& facts, const rendering::RenderRequest& request);

/// Empty where the folder is missing, was made from something else, or holds an altered file.
std::optional<KeptImages> readImageFolder(const std::filesystem::path& folder, const std::string& key,
                                          const rendering::RenderRequest& request);

void writeImageFolder(const std::filesystem::path& folder, const std::string& key, const std::string& renderJson,
                      const rendering::Rendering& rendering, const std::string& signalsJson,
                      const std::vector<std::string>& stamps);

}  // namespace study::making
