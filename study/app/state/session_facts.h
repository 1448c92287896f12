// What stays the same during a session and is shown in it. No page sees the plan that it is taken from, for that
// carries file codes.
#pragma once

#include <QString>
#include <QStringList>
#include <optional>

#include "protocols/protocol.h"

namespace study::app {

struct SessionFacts {
    QString participant;
    QString consent;                              ///< what is confirmed when the participant agrees
    QStringList facts;                            ///< asked about the participant
    QStringList checklist, readings;              ///< of each sitting
    QString strokeWords;                          ///< said the same for glass and cloth
    std::optional<protocols::RatingScale> scale;  ///< of the first rating question
    int sittingMinutes = 60;                      ///< a sitting's planned length
    bool secondEntry = false;                     ///< every answer is entered twice and must agree
    bool displayReportsTouches = false;
};

/// How the words about stroking stand on the pages of a presentation; empty where the protocol has none.
QString strokeText(const SessionFacts& facts);

}  // namespace study::app
