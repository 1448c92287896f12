// The folder of `vis2hap study new --images`: the named friction images of a study, for inspection and reuse. They are reused
// only if all their inputs and the hash of every file are unchanged.
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
    std::vector<std::string> stamps;  ///< sentences about the images that every report must carry
};

/// SHA-256 over all inputs of the images: data set, fabrics, samples, conditions, weights and version of the program.
std::string imageFolderKey(const database::StudyFacts& facts, const rendering::RenderRequest& request);

/// None where the folder is missing, was made from other inputs, or contains a changed file.
std::optional<KeptImages> readImageFolder(const std::filesystem::path& folder, const std::string& key,
                                          const rendering::RenderRequest& request);

void writeImageFolder(const std::filesystem::path& folder, const std::string& key, const std::string& renderJson,
                      const rendering::RenderedFabrics& rendering, const std::string& signalsJson,
                      const std::vector<std::string>& stamps);

}  // namespace study::making
