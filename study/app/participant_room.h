// The participant's part of the window: what the open study and session tell the participant, on their screen and in their
// headphones, and what their acts do to the session.
#pragma once

#include <QObject>

#include "study/app/participant/participant_side.h"
#include "study/app/participant/participant_sound.h"
#include "study/session/view.h"

namespace study::app {

class OpenStudy;
class SessionController;

class ParticipantRoom : public QObject {
    Q_OBJECT
public:
    explicit ParticipantRoom(QObject* parent);

    ParticipantSide& side() const { return *m_side; }
    ParticipantSound& sound() const { return *m_sound; }

    /// A session begins or continues: no prompts for what happened before.
    void begin(const SessionController& session);
    /// Tells the participant what belongs to this moment, in the words and with the prompts of the session, else of the study.
    /// Both may be null.
    void tell(OpenStudy* study, const SessionController* session);
    /// Sends the act to the session. True if the session shows something else to the operator now.
    bool take(const participant::ParticipantAct& act, SessionController& session);

private:
    ParticipantSide* m_side;
    ParticipantSound* m_sound;
    session::View m_told;  ///< the moment of the session that the participant was told about last
};

}  // namespace study::app
