#include "study/app/session_room.h"

#include <utility>

#include "study/app/display_choice.h"
#include "study/app/language/below.h"
#include "study/app/pages/session_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/participant_room.h"
#include "study/app/window_pages.h"

namespace study::app {

namespace {

QString faultText(const std::exception_ptr& fault)
{
    try {
        std::rethrow_exception(fault);
    } catch (const std::exception& thrown) {
        return inOwnLanguage(thrown.what());
    }
}

}  // namespace

SessionRoom::SessionRoom(const AppOptions& options, const std::unique_ptr<OpenStudy>& openStudy, WindowPages& pages,
                         ParticipantRoom& participantRoom, const DisplayChoice& displayChoice)
    : m_options(options),
      m_openStudy(openStudy),
      m_pages(pages),
      m_participantRoom(participantRoom),
      m_displayChoice(displayChoice)
{
    connectPage();
    connect(&participantRoom.side(), &ParticipantSide::acted, this, &SessionRoom::takeAct);
    connect(&participantRoom.sound(), &ParticipantSound::stateChanged, this, &SessionRoom::showSoundFault);
}

void SessionRoom::connectPage()
{
    connect(m_pages.session, &SessionPage::correctionRequested, this,
            [this] { m_pages.session->openCorrection(m_controller->correctables()); });
    connect(m_pages.session, &SessionPage::eventRequested, this, [this](const session::EventBody& event) {
        if (m_controller) m_controller->send(event);
    });
    connect(m_pages.session, &SessionPage::hintShown, this, [this] {
        if (m_controller) m_controller->pageAsked();
    });
    connect(m_pages.session, &SessionPage::answerMarked, this, [this](AnswerMark mark) {
        if (!m_controller) return;
        if (mark == AnswerMark::Emptied)
            m_controller->unmarkEntry();
        else
            m_controller->markAnswerBegun(mark == AnswerMark::Spoken ? session::BegunBy::Spoken : session::BegunBy::Entry);
    });
    connect(m_pages.session, &SessionPage::patternRequested, this, [this](const std::optional<TestPattern>& pattern) {
        if (m_controller) m_controller->showPattern(pattern, m_displayChoice.mmPerPixel());
    });
}

void SessionRoom::connectController()
{
    connect(m_controller.get(), &SessionController::viewChanged, this, &SessionRoom::refresh);
    connect(m_controller.get(), &SessionController::reported, m_pages.session, &SessionPage::showMessage);
    connect(m_controller.get(), &SessionController::patternShown, m_pages.session, &SessionPage::showPattern);
}

void SessionRoom::begin(OpenStudy& study, const protocols::ParticipantId& participant,
                        std::unique_ptr<rendering::HapticDisplay> display)
{
    m_controller = std::make_unique<SessionController>(study.store(), participant, study.images(), std::move(display),
                                                       m_options.clock, m_options.kind, m_displayChoice.operatedBy(), nullptr);
    m_leavingWasRefused = false;
    connectController();
    SessionFacts facts = m_controller->facts();
    facts.isRehearsal = &study != m_openStudy.get();
    facts.isAtStation = study.isAtStation();
    facts.keys = m_pages.keys->keys();
    facts.mmPerPixel = m_displayChoice.mmPerPixel();
    m_pages.session->begin(facts);
    m_pages.setCurrentWidget(m_pages.session);
    Q_EMIT begun(facts);
    present();
    m_participantRoom.begin(*m_controller);
    tellParticipant();
    m_soundFault.clear();  // a fault from before the session matters in it, too
    showSoundFault();
}

void SessionRoom::present() { m_pages.session->present(m_controller->view(), m_controller->canCorrect()); }

void SessionRoom::showNow()
{
    if (!m_controller) return;
    m_controller->refresh();  // else the clock of a break would stand at its last event
    present();
}

void SessionRoom::refresh()
{
    // When the display fails, the event is stored nevertheless. A touch or a fault that the display reports, or an act of the
    // participant, can come at any time, so it must not close a panel that the operator is using.
    const auto& outcome = m_controller->lastOutcome();
    const bool isByDisplay = outcome->cause == Cause::DisplayFault;
    const bool isByOperator = outcome->cause == Cause::Usual && session::isEnteredByOperator(outcome->event);
    const bool isAccepted = !outcome->refusal && !outcome->fault;
    const bool hasMovedOn = m_pages.session->shownView().state != m_controller->view().state;
    if (isByOperator && (isAccepted || hasMovedOn)) m_pages.session->closePanelAndMessage();
    if (isByDisplay && hasMovedOn) m_pages.session->holdKeys(SessionPage::MovedBy::Display);
    present();
    tellParticipant();
    Q_EMIT viewChanged();
}

void SessionRoom::tellParticipant() { m_participantRoom.tell(m_openStudy.get(), m_controller.get()); }

void SessionRoom::takeAct(const participant::ParticipantAct& act)
{
    if (!m_controller) return;
    const int sentBefore = m_controller->eventsSent();
    if (m_participantRoom.take(act, *m_controller)) m_pages.session->holdKeys();
    const auto& outcome = m_controller->lastOutcome();
    const bool isStored = m_controller->eventsSent() > sentBefore && !outcome->refusal && !outcome->fault;
    const auto* agreement = std::get_if<participant::Agreement>(&act.what);
    const bool isDisagreement = agreement && !agreement->agrees;  // the operator must know it, stored or not
    if (isStored || isDisagreement) m_pages.session->showAct(act);
}

void SessionRoom::showSoundFault()
{
    const QString fault = m_participantRoom.sound().state().fault;
    const bool isNew = std::exchange(m_soundFault, fault) != fault;
    if (m_controller && isNew && !fault.isEmpty())
        m_pages.session->showMessage(tr("%1. F4 opens the page of the headphones.").arg(fault), Tone::Fault);
}

bool SessionRoom::pauseForLeaving()
{
    const session::State& state = m_controller->view().state;
    const bool isOver =
        std::holds_alternative<session::Finished>(state.stage) || std::holds_alternative<session::Withdrawn>(state.stage);
    if (state.paused || isOver) return true;
    m_controller->send(session::Paused{});
    const std::exception_ptr fault = m_controller->lastOutcome()->fault;
    if (!fault || m_leavingWasRefused) return true;
    m_leavingWasRefused = true;
    m_pages.setCurrentWidget(m_pages.session);
    m_pages.session->showMessage(tr("%1. The pause was not stored, so the session is still open. Fix the problem, or leave once "
                                    "more: no stored answer is lost.")
                                     .arg(faultText(fault)),
                                 Tone::Fault);
    return false;
}

}  // namespace study::app
