// The controls beside the generated signals of a study, and the measures of `vis2hap evaluate`, in the object `signals` of
// results.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/evaluation/study_comparison.h"
#include "study/making/study_material.h"

namespace study::making {

/// What a study's controls are computed from.
struct ControlsRequest {
    const StudyMaterial& material;
    const rendering::RenderedFabrics& rendering;  ///< has the generated signals, and says which measured ones the study shows
    const std::string& datasetSha256;
    std::uint64_t seed = 1;
};

/// Adds to `json` the measures of the generated signals, `generated`, `generated_mean` and `controls`. Measures that do not exist
/// are null with their reason. So are all of them where no signals are generated, or where a file of the data set is broken.
void addControls(nlohmann::ordered_json& json, const ControlsRequest& request, const evaluation::Report& report = {});

/// The fields of addControls() from a comparison.
void putComparison(nlohmann::ordered_json& json, const evaluation::StudyComparison& comparison);

}  // namespace study::making
