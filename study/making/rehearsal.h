// A rehearsal of a study: a small study of its own with a few presentations of each phase, which the operator plays through
// before the first participant comes. It lies in a temporary folder and vanishes with its last owner, so nothing of it becomes
// data.
#pragma once

#include <filesystem>
#include <memory>

namespace study::making {

/// The folder of the rehearsal's study. The presentations are drawn anew from the last place of `study`, so they foretell no
/// participant's order. Breaks come after two presentations. Throws the errors of database::StudyStore, and workFailed where the
/// station key or a stimulus is missing.
std::shared_ptr<const std::filesystem::path> makeRehearsal(const std::filesystem::path& study);

}  // namespace study::making
