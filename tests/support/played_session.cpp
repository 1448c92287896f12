#include "tests/support/played_session.h"

#include <map>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "study/session/preparation.h"
#include "study/session/session_record.h"
#include "study/session/stimuli.h"

namespace tests::support {

using namespace study::session;

namespace {

unsigned fingerprint(const std::string& text)
{
    unsigned sum = 2166136261u;  // FNV-1a
    for (const unsigned char c : text) sum = (sum ^ c) * 16777619u;
    return sum;
}

protocols::Tenths ratingFrom(unsigned draw, const protocols::RatingScale& scale)
{
    const int steps = (scale.max.value - scale.min.value) / scale.step.value;
    return {scale.min.value + scale.step.value * static_cast<int>(draw % static_cast<unsigned>(steps + 1))};
}

std::map<std::string, std::string> filledIn(const std::vector<std::string>& captions)
{
    std::map<std::string, std::string> filled;
    for (const std::string& caption : captions) filled[caption] = std::to_string(20 + filled.size());
    return filled;
}

struct NextEventOfView {
    const View& view;
    const Plan& plan;
    std::optional<EventBody> operator()(const Enrolled&) const { return Begun{}; }
    std::optional<EventBody> operator()(const Consenting&) const { return Consented{}; }
    std::optional<EventBody> operator()(const AskingFacts&) const { return FactsGiven{filledIn(plan.protocol.facts)}; }
    std::optional<EventBody> operator()(const Familiarising&) const { return FamiliarisationDone{}; }
    std::optional<EventBody> operator()(const ScaleTraining&) const { return ScaleTrainingDone{}; }
    std::optional<EventBody> operator()(const CheckingList&) const
    {
        return ChecklistDone{plan.protocol.checklist, filledIn(plan.protocol.readings)};
    }
    std::optional<EventBody> operator()(const PlacingTray&) const
    {
        return trayReadyOf(plan.protocol, view.trayIds, plan.fabricNames);
    }
    std::optional<EventBody> operator()(const Presenting&) const { return Answered{responseTo(view)}; }
    std::optional<EventBody> operator()(const OnBreak&) const { return BreakEnded{}; }
    std::optional<EventBody> operator()(const Debriefing&) const { return Debriefed{"it was fun"}; }
    std::optional<EventBody> operator()(const Finished&) const { return std::nullopt; }
    std::optional<EventBody> operator()(const Withdrawn&) const { return std::nullopt; }
};

}  // namespace

void FakeDisplay::show(const cv::Mat& image)
{
    if (onShow) onShow();
    if (!fault.empty()) throw protocols::workFailed({fault, "fake display", "", ""});
    calls.push_back("show " + std::to_string(image.at<unsigned char>(0, 0)));
}

void FakeDisplay::clear() { calls.push_back("clear"); }

OpenSession::OpenSession(const database::StudyFolder& folder, const std::string& participant, database::ParticipantKind kind,
                         const study::session::OperatedBy& operatedBy)
    : store(folder, database::StudyStore::Access::Write), bank(stimuliOf(store))
{
    driver = std::make_unique<Driver>(store, protocols::ParticipantId(participant), kind, bank, display, clock, operatedBy);
}

void SessionHands::send(const EventBody& event)
{
    if (const auto refusal = driver->send(event))
        throw std::logic_error("\"" + kindOf(event) + "\" in " + nameOf(driver->state()) + " was refused: " + refusal->reason);
}

bool SessionHands::step()
{
    const auto* presenting = std::get_if<Presenting>(&driver->state().stage);
    if (presenting && !driver->state().paused) {
        clock.advanceSeconds(1.25);
        if (presenting->question == 0 && !presenting->touchedAtNs) send(Touched{});
        clock.advanceSeconds(2.5);
    }
    if (std::holds_alternative<PlacingTray>(driver->state().stage)) clock.advanceSeconds(driver->plan().protocol.deadTimeSeconds);
    const auto event = nextEvent(driver->view(), driver->plan());
    if (event) send(*event);
    return event.has_value();
}

void SessionHands::playUntilAnswers(int answers)
{
    while (driver->state().answersStored < answers && step()) {
    }
}

void SessionHands::playToEnd()
{
    while (step()) {
    }
}

void SessionHands::stepUntil(const std::string& stateName)
{
    while (nameOf(driver->state()) != stateName)
        if (!step()) throw std::logic_error("the session ended before " + stateName);
}

std::optional<EventBody> nextEvent(const View& view, const Plan& plan)
{
    if (view.state.paused) return Resumed{};
    return std::visit(NextEventOfView{view, plan}, view.state.stage);
}

std::vector<std::string> linesOf(const database::StudyStore& store)
{
    std::vector<std::string> lines;
    for (const database::CurrentAnswer& answer : store.answers()) {
        const database::AnswerRecord& record = answer.record;
        lines.push_back(std::to_string(record.trial.value) + " " + record.question.value + " " + record.presentationCode.value +
                        " " + (record.answer ? *record.answer : std::to_string(record.rating->value)));
    }
    return lines;
}

GivenAnswer responseTo(const View& view)
{
    const unsigned draw = fingerprint(view.code.value + view.question->id.value);
    return std::visit(
        protocols::Overloaded{
            [&](const protocols::ForcedChoice&) -> GivenAnswer { return view.trayIds[draw % view.trayIds.size()]; },
            [&](const protocols::Rating& rating) -> GivenAnswer { return ratingFrom(draw, rating.scale); },
            [&](const protocols::SameDifferent&) -> GivenAnswer { return Sameness{draw % 2 == 0}; },
            [&](const protocols::FreeText&) -> GivenAnswer { return Words{"as number " + std::to_string(draw % 9)}; }},
        view.question->kind);
}

}  // namespace tests::support
