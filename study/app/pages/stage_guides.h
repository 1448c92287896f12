// What the operator is told at each stage that is confirmed and no more.
#pragma once

#include <QStringList>
#include <optional>

#include "study/app/state/session_facts.h"
#include "study/session/driver.h"

namespace study::app {

/// What a button of a guide does.
enum class GuideAct { Send, Leave, DeclinePreparation };

/// The words of one guide page.
struct Guide {
    struct Second {
        QString text;
        int key = 0;
        GuideAct act = GuideAct::Leave;
    };
    QString title;
    QString lead;  ///< one sentence under the title
    QStringList steps;
    QString action;            ///< on the button that Enter presses
    session::EventBody event;  ///< what it sends
    GuideAct act = GuideAct::Send;
    std::optional<Second> second = {};  ///< another way to go on
};

/// Empty for stages that have a page of their own. `isPreparationDue`: a later sitting has begun, and its
/// refresher and checklist are offered first.
std::optional<Guide> guideFor(const session::View& view, const SessionFacts& facts, bool isPreparationDue);

}  // namespace study::app
