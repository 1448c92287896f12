// A rehearsal of a study: a small study of its own with a few presentations of each phase, which the operator plays through
// before the first participant comes. It lies in a temporary folder and vanishes with its last owner, so nothing of it becomes
// data. It holds neither a presentation nor an image nor a key of the study: who reads all of it learns nothing of a real trial.
#pragma once

#include <filesystem>
#include <memory>

namespace study::making {

/// The folder of the rehearsal's study. Running order, codes and station key are drawn anew by a secret of their own. The images
/// are drawn patterns. Protocol, fabrics and codes on the pieces are those of `study`. Breaks come after two presentations.
/// Throws the errors of database::StudyStore, badInput for a study on a server, and workFailed where the station key or a
/// stimulus of `study` is missing or altered.
std::shared_ptr<const std::filesystem::path> makeRehearsal(const std::filesystem::path& study);

}  // namespace study::making
