#include "tests/support/played_session.h"

#include <stdexcept>

#include "protocols/errors.h"

namespace tests::support {

using namespace study::session;

namespace {

unsigned fingerprint(const std::string& text)
{
    unsigned sum = 2166136261u;  // FNV-1a
    for (const unsigned char c : text) sum = (sum ^ c) * 16777619u;
    return sum;
}

}  // namespace

void FakeDisplay::show(const cv::Mat& image)
{
    if (onShow) onShow();
    if (!fault.empty()) throw protocols::workFailed({fault, "fake display", "", ""});
    told.push_back("show " + std::to_string(image.at<unsigned char>(0, 0)));
}

void FakeDisplay::clear() { told.push_back("clear"); }

OpenSession::OpenSession(const database::StudyFolder& folder, const std::string& participant, database::ParticipantKind kind)
    : store(folder, database::StudyStore::Access::Write),
      bank(folder.stimuli(), store.stimulusHashes()),
      driver(std::make_unique<Driver>(store, protocols::ParticipantId(participant), kind, bank, display, clock))
{
}

void OpenSession::send(const EventBody& event)
{
    if (const auto refusal = driver->send(event))
        throw std::logic_error("\"" + kindOf(event) + "\" in " + nameOf(driver->state()) + " was refused: " + refusal->reason);
}

bool OpenSession::step()
{
    const Stage& stage = driver->state().stage;
    if (driver->state().paused)
        send(Resumed{});
    else if (std::holds_alternative<Enrolled>(stage))
        send(Begun{});
    else if (std::holds_alternative<Familiarising>(stage))
        send(FamiliarisationDone{});
    else if (std::holds_alternative<ScaleTraining>(stage))
        send(ScaleTrainingDone{});
    else if (std::holds_alternative<PlacingTray>(stage))
        send(TrayReady{});
    else if (std::holds_alternative<OnBreak>(stage))
        send(BreakEnded{});
    else if (const auto* presenting = std::get_if<Presenting>(&stage)) {
        clock.advanceSeconds(1.25);
        if (presenting->question == 0) send(Touched{});
        clock.advanceSeconds(2.5);
        send(Answered{responseTo(driver->view())});
    } else {
        return false;
    }
    return true;
}

void OpenSession::playUntilAnswers(int answers)
{
    while (driver->state().answersStored < answers && step()) {
    }
}

void OpenSession::playToEnd()
{
    while (step()) {
    }
}

void OpenSession::stepUntil(const std::string& stateName)
{
    while (nameOf(driver->state()) != stateName)
        if (!step()) throw std::logic_error("the session ended before " + stateName);
}

Response responseTo(const View& view)
{
    const unsigned draw = fingerprint(view.code.value + view.question->id.value);
    if (view.scale) return protocols::Tenths{static_cast<int>(draw % 101)};
    return view.trayIds[draw % view.trayIds.size()];
}

}  // namespace tests::support
