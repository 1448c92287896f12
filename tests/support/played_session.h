// Plays sessions for tests: sends what the present state asks for, with responses that follow from the
// trial alone, so that an interrupted and an uninterrupted session must store the same answers.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rendering/display/display.h"
#include "study/session/driver.h"

namespace tests::support {

/// Records every call; throws where `fault` is set.
class FakeDisplay final : public rendering::HapticDisplay {
public:
    void show(const cv::Mat& image) override;
    void clear() override;
    std::string name() const override { return "fake"; }

    std::vector<std::string> calls;  ///< "show 30" (the pixel value), "clear"
    std::string fault;               ///< not empty: show throws workFailed with this text
    std::function<void()> onShow;
};

/// A store open for writing with one participant's driver, bank, display and clock.
struct OpenSession {
    OpenSession(const database::StudyFolder& folder, const std::string& participant,
                database::ParticipantKind kind = database::ParticipantKind::Scripted);

    database::StudyStore store;
    rendering::StimulusBank bank;
    FakeDisplay display;
    study::session::VirtualClock clock;
    std::unique_ptr<study::session::Driver> driver;

    /// Throws std::logic_error where the event is refused, so that a test stops there.
    void send(const study::session::EventBody& event);
    /// The one step that leads on from here, with the touch before a presentation's first answer. False at the end.
    bool step();
    /// Steps until `answers` are stored (ever), or the end.
    void playUntilAnswers(int answers);
    void playToEnd();
    /// Until the question is asked next (PlacingTray -> Presenting ...).
    void stepUntil(const std::string& stateName);
};

/// The one event that leads on from here: begin, consent, tray, answer, break's end ... Every line of the checklist is
/// ticked, every fact and reading is told. None at the end.
std::optional<study::session::EventBody> nextEvent(const study::session::View& view, const study::session::Plan& plan);

/// By the code of the presentation and the question.
study::session::Response responseTo(const study::session::View& view);

}  // namespace tests::support
