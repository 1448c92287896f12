// Plays sessions for tests: sends the event that the current state waits for. Responses depend only on the trial, so that an
// interrupted and an uninterrupted session store the same answers.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "rendering/display/display.h"
#include "rendering/display/stimulus_bank.h"
#include "study/session/driver.h"

namespace tests::support {

/// Records every call; throws where `fault` is set.
class FakeDisplay final : public rendering::HapticDisplay {
public:
    void show(const cv::Mat& image) override;
    void clear() override;
    std::string name() const override { return "fake"; }

    std::vector<std::string> calls;  ///< "show 30" (with the pixel value), "clear"
    std::string fault;               ///< if not empty, show() throws workFailed with this text
    std::function<void()> onShow;
    bool fetchesImages() const override { return isFetching; }
    bool isFetching = false;
};

/// Driver, display and clock of one participant, for a store of either kind.
struct SessionHands {
    FakeDisplay display;
    study::session::VirtualClock clock;
    std::unique_ptr<study::session::Driver> driver;

    /// Sends the event. Throws std::logic_error if it is refused, so that the test stops.
    void send(const study::session::EventBody& event);
    /// Sends the next event, and before the first answer to a presentation also a touch. False at the end.
    bool step();
    /// Steps until `answers` answers are stored in the whole session, or until the end.
    void playUntilAnswers(int answers);
    void playToEnd();
    /// Steps until the state has this name ("PlacingTray", "Presenting", …).
    void stepUntil(const std::string& stateName);
};

/// The session in a study folder: its store, open for writing, and its stimulus bank.
struct OpenSession : SessionHands {
    OpenSession(const database::StudyFolder& folder, const std::string& participant,
                database::ParticipantKind kind = database::ParticipantKind::Scripted,
                const study::session::OperatedBy& operatedBy = {});
    ~OpenSession() { driver.reset(); }

    database::StudyStore store;
    rendering::StimulusBank bank;
};

/// The event that continues the session from `view`: begin, consent, tray ready, answer, end of break, … It ticks every line
/// of the checklist and fills in every fact and reading. Empty at the end of the session.
std::optional<study::session::EventBody> nextEvent(const study::session::View& view, const study::session::Plan& plan);

/// "TRIAL QUESTION CODE ANSWER" for each stored answer, in the order of slots and trials.
std::vector<std::string> linesOf(const database::StudyStore& store);

/// GivenAnswer that depends only on the code of the presentation and the question.
study::session::GivenAnswer responseTo(const study::session::View& view);

}  // namespace tests::support
