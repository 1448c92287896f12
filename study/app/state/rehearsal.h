// What the window needs for a rehearsal: a maker of its study, and what was tried.
#pragma once

#include <QString>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <memory>

namespace study::app {

/// The folder of a small study made from `study`. It vanishes with the last owner of the result. Throws protocols::Error.
using MakeRehearsal = std::function<std::shared_ptr<const std::filesystem::path>(const std::filesystem::path& study)>;

/// The participant of every rehearsal.
inline constexpr const char* rehearsalParticipant = "REHEARSAL";

/// What has to be in order before a participant comes.
struct RehearsalState {
    bool displayIsThere = false, patternWasFelt = false, soundWasHeard = false, sheetsAreThere = false;
    QStringList piecesLeft;         ///< codes of pieces that were not read yet
    QString diskFault, clockFault;  ///< empty: in order
    bool sessionWasPlayed = false;  ///< to its end

    /// What is missing, each as a phrase; empty: all is ready.
    QStringList missing() const;
};

}  // namespace study::app
