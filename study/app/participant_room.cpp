#include "study/app/participant_room.h"

#include "study/app/state/open_study.h"
#include "study/app/state/session_controller.h"
#include "study/participant/session/present_instruction.h"
#include "study/participant/session/prompts.h"

namespace study::app {

namespace {

/// `protocol`: the version that the participant follows. An amendment changes its words, but no recording.
SaidPrompts promptsOf(OpenStudy& study, const protocols::Protocol& protocol)
{
    SaidPrompts prompts{{}, participant::spokenTexts(protocol), protocol.language};
    for (const auto& [key, file] : protocol.prompts) prompts.files[key] = study.store().folder().prompt(key).string();
    return prompts;
}

}  // namespace

ParticipantRoom::ParticipantRoom(QObject* parent)
    : QObject(parent), m_side(new ParticipantSide(this)), m_sound(new ParticipantSound(this))
{
}

void ParticipantRoom::begin(const SessionController& session) { m_told = session.view(); }

void ParticipantRoom::tell(OpenStudy* study, const SessionController* session)
{
    const protocols::Protocol none;
    const protocols::Protocol& followed = session ? session->plan().protocol : study ? study->protocol() : none;
    m_side->setWords(followed);
    m_sound->setPrompts(study ? promptsOf(*study, followed) : SaidPrompts{});
    if (!session) return m_side->show(participant::waiting(followed));
    m_side->show(participant::instructionFor(session->view(), followed));
    m_sound->say(participant::promptsBetween(m_told, session->view()));
    m_told = session->view();
}

bool ParticipantRoom::take(const participant::ParticipantAct& act, SessionController& session)
{
    const auto event = participant::eventOf(act, session.view(), session.plan().protocol);
    if (!event) return false;
    const auto shown = [&] { return std::pair(session.view().state.stage.index(), session.view().placeToName.has_value()); };
    const auto before = shown();
    session.sendOfParticipant(*event);
    return shown() != before;
}

}  // namespace study::app
