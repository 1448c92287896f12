// Texts for the operator at every stage that needs only a confirmation.
#pragma once

#include <QStringList>
#include <optional>

#include "study/app/state/session_facts.h"
#include "study/session/driver.h"

namespace study::app {

/// Action of a button on a guide page.
enum class GuideAct { Send, Leave, DeclinePreparation };

/// Texts and actions of one guide page.
struct Guide {
    struct Second {
        QString text;
        int key = 0;
        GuideAct act = GuideAct::Leave;
    };
    QString title;
    QString lead;  ///< shown under the title
    QStringList steps;
    QString action;            ///< text of the button that Enter presses
    session::EventBody event;  ///< sent by this button if `act` is Send
    GuideAct act = GuideAct::Send;
    std::optional<Second> second = {};  ///< second button with its own key
};

/// The guide for the stage of `view`; empty for stages that have their own page. `isPreparationDue`: a later sitting has
/// begun, and its refresher and checklist come first.
std::optional<Guide> guideFor(const session::View& view, const SessionFacts& facts, bool isPreparationDue);

}  // namespace study::app
