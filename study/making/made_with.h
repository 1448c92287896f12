// What a study was made with, so that its stimuli can be made again: program, compiler, libraries, weights and settings.
#pragma once

#include <map>
#include <string>

#include "study/making/new_study.h"
#include "study/making/study_material.h"

namespace study::making {

/// A JSON object for StudyFacts::madeWith. A commit that the build did not know, and weights that no condition needs, are null.
/// `prompts`: bytes of the recordings by key, whose hashes are kept. `material`: its own images and programs stand by condition,
/// and the response of the display whole.
std::string madeWith(const NewStudy& request, const std::string& weightsSha256, const std::map<std::string, std::string>& prompts,
                     const StudyMaterial& material);

}  // namespace study::making
