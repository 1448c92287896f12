// What the window needs from outside, as a value: which study, which display, whose clock, where
// settings are kept and how a new study is made. main and tests put it together; nothing here is global.
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
#include "study/app/state/data_look.h"
#include "study/app/state/monitor.h"
#include "study/app/state/screen_cover.h"
#include "study/session/clock.h"

namespace study::app {

/// What the form for a new study was filled with.
struct NewStudyRequest {
    std::filesystem::path study;  ///< a folder that does not exist yet
    std::filesystem::path dataset;
    std::optional<std::filesystem::path> protocol;  ///< none: the paper's study
    std::optional<int> participants;                ///< none: as the protocol says
    std::uint64_t seed = 1;
    bool operator==(const NewStudyRequest&) const = default;
};

/// How far the making is, 0..1, and what is being done. Throws to stop the work when the experimenter
/// asks for that, so the maker must leave nothing half-made when an exception passes through it.
using MakingProgress = std::function<void(double fraction, const std::string& what)>;

/// Makes the study or throws protocols::Error. Called off the GUI thread.
using MakeStudy = std::function<void(const NewStudyRequest&, const MakingProgress&)>;

using OpenDisplay = std::function<std::unique_ptr<rendering::HapticDisplay>(const std::string& specification)>;

struct AppOptions {
    std::optional<std::filesystem::path> study;  ///< opened at the start
    std::string display = "none";                ///< specification for `openDisplay`
    OpenDisplay openDisplay = app::openDisplay;
    MakeStudy makeStudy;                    ///< empty: the window makes no studies
    std::shared_ptr<session::Clock> clock;  ///< empty: the system's
    std::shared_ptr<QSettings> settings;    ///< recent studies and looks; empty: nothing is remembered
    LookAtData lookAtData;                  ///< empty: the window shows no data sets
    ReadFlags readFlags;                    ///< for the monitor; empty: it shows no flags
    database::ParticipantKind kind = database::ParticipantKind::Human;
};

}  // namespace study::app
