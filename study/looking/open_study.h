// Protection of blinding: nobody may view the stimuli of a study that still runs.
#pragma once

#include <filesystem>

namespace study::looking {

/// Throws badInput if the file or folder, after following links, lies in a study that is not unblinded or whose study.db cannot
/// be read. A QCoreApplication must exist.
void requireNotOfOpenStudy(const std::filesystem::path& place);

}  // namespace study::looking
