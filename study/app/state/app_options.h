// Inputs of the window as one value: study, display, clock, settings, and the function that makes
// a study. main and the tests fill it; nothing is global.
#pragma once

#include <QSettings>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "database/study_store.h"
#include "rendering/display/display.h"
#include "study/app/drafts/session_outlook.h"
#include "study/app/language/language.h"
#include "study/app/state/data_look.h"
#include "study/app/state/monitor.h"
#include "study/app/state/photograph_steps.h"
#include "study/app/state/rehearsal.h"
#include "study/app/state/screen_cover.h"
#include "study/app/state/study_tool.h"
#include "study/session/clock.h"
#include "study/session/operated_by.h"

namespace study::app {

/// Input of the form for a new study.
struct NewStudyRequest {
    std::filesystem::path study;  ///< a folder that does not exist yet
    std::filesystem::path dataset;
    std::optional<std::filesystem::path> protocol;  ///< none: the study of the paper
    std::optional<int> participants;                ///< none: the number in the protocol
    std::uint64_t seed = 1;
    std::optional<std::string> passphrase;  ///< seals the allocation key; none: the key lies open
    std::string language = "en";            ///< of the participants, in the study of the paper
    bool operator==(const NewStudyRequest&) const = default;
};

/// Reports the share done (0..1) and the current step. Throws if the experimenter stops the work; the maker must then leave no
/// unfinished study behind.
using MakingProgress = std::function<void(double fraction, const std::string& what)>;

/// Makes the study or throws protocols::Error. Called on a worker thread. Returns remarks for the experimenter, such as on images
/// that no participant can feel.
using MakeStudy = std::function<std::vector<std::string>(const NewStudyRequest&, const MakingProgress&)>;

/// Opens a display as app::openDisplay() does. Displays with a driver are opened on a worker thread.
using OpenDisplay =
    std::function<std::unique_ptr<rendering::HapticDisplay>(const std::string& specification, const std::stop_token& stop)>;

struct AppOptions {
    std::optional<std::filesystem::path> study;  ///< opened at the start
    std::string display = "none";                ///< argument of `openDisplay`
    bool isDisplayGiven = false;     ///< the operator named `display`: it replaces the remembered one, and "none" is meant
    bool allowsPlainImages = false;  ///< whether the display page offers folder:DIR
    OpenDisplay openDisplay = app::openDisplay;
    MakeStudy makeStudy;                    ///< empty: the window offers no new study
    std::shared_ptr<session::Clock> clock;  ///< empty: the system's clock
    std::shared_ptr<QSettings> settings;    ///< recent studies, display and appearance; empty: nothing is stored
    LookAtData lookAtData;                  ///< empty: the window offers no data sets
    LookAhead lookAhead;                    ///< empty: the editor of protocols shows neither power nor balance
    PhotographSteps photographs;            ///< empty: the window offers no data set from photographs
    UseTool useTool;                        ///< empty: the study page offers no tools
    MakeRehearsal makeRehearsal;            ///< empty: the study page offers no rehearsal
    ReadFlags readFlags;                    ///< for the monitor; empty: no flags are shown
    Language language;                      ///< of the window's texts, which are in use already
    QString languageFault;                  ///< why a kept language could not be used; empty: it could, or none is kept
    database::ParticipantKind kind = database::ParticipantKind::Human;
    session::OperatedBy operatedBy;  ///< recorded with every sitting
};

}  // namespace study::app
