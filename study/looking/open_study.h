// The stimuli of a study that still runs are looked at by nobody: who has seen them is not blinded any more.
#pragma once

#include <filesystem>

namespace study::looking {

/// Throws badInput where the file or folder lies (after following links) inside a study that is not unblinded, or whose
/// study.db cannot be read. A QCoreApplication must exist.
void requireNotOfOpenStudy(const std::filesystem::path& place);

}  // namespace study::looking
