// Facts that stay the same during a session and are shown in it. They are copied from the plan, which no page sees because
// it contains file codes.
#pragma once

#include <QString>
#include <QStringList>
#include <optional>

#include "protocols/protocol.h"
#include "protocols/usual_texts.h"
#include "study/app/state/key_bindings.h"

namespace study::app {

struct SessionFacts {
    QString participant;
    QString consent;                              ///< statement that the operator confirms when the participant agrees
    QStringList facts;                            ///< questions about the participant
    QStringList checklist, readings;              ///< gone through in each sitting
    QString strokeWords;                          ///< instruction for stroking, the same for glass and fabric
    std::optional<protocols::RatingScale> scale;  ///< scale of the first rating question
    int sittingMinutes = 60;                      ///< planned duration of a sitting, min
    bool secondEntry = false;                     ///< every answer is entered twice and must agree
    bool confirmPieces = false;                   ///< every piece on the tray is confirmed by its code
    bool displayReportsTouches = false;
    bool displayTakesTickets = false;       ///< it fetches its images by itself, so it plays no test patterns
    bool isRehearsal = false;               ///< nothing of this session becomes data
    bool isAtStation = false;               ///< the study lies on a server, which holds back places of participants who withdrew
    QString displayName;                    ///< empty: the session runs without a display
    KeyBindings keys = {};                  ///< extra keys of the operator's acts
    std::optional<double> mmPerPixel = {};  ///< scale of the display, mm per pixel, if the operator measured it
    protocols::TextsByKey said = {};        ///< what the operator says to the participant, in the participant's language
    bool hasOwnLowEnd = false;              ///< the study words this end of the scale itself; it may name other materials
    bool hasOwnHighEnd = false;

    /// The sentence with this key (protocols::usualParticipantTexts()), with values for its names in braces.
    QString sentence(std::string_view key, const protocols::TextsByKey& values = {}) const
    {
        const auto found = said.find(key);
        return found == said.end() ? QString() : QString::fromStdString(protocols::filledText(found->second, values));
    }
};

/// Whether one of these keys has a text of the study's own.
inline bool hasOwnText(const protocols::Protocol& protocol, const char* onCard, const char* atLine)
{
    return protocol.participantTexts.contains(onCard) || protocol.participantTexts.contains(atLine);
}

/// The stroking instruction as the pages of a presentation show it; empty if the protocol has none.
QString strokeText(const SessionFacts& facts);

}  // namespace study::app
