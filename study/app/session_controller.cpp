#include "study/app/session_controller.h"

#include "protocols/errors.h"
#include "study/app/rating_text.h"
#include "study/app/stage_page.h"

#include <algorithm>

namespace study::app {

using session::Response;
using session::StoredAnswer;

SessionController::SessionController(database::StudyStore& store, const protocols::ParticipantId& participant,
                                     rendering::StimulusBank& bank, std::unique_ptr<rendering::HapticDisplay> display,
                                     std::shared_ptr<session::Clock> clock, database::ParticipantKind kind, QObject* parent)
    : QObject(parent),
      m_display(std::move(display)),
      m_clock(std::move(clock)),
      m_driver(store, participant, kind, bank, *m_display, *m_clock),
      m_view(m_driver.view())
{
}

void SessionController::send(const session::EventBody& event)
{
    m_lastOutcome = Outcome{event, std::nullopt, nullptr};
    ++m_eventsSent;
    QString trouble;
    try {
        m_lastOutcome->refusal = m_driver.send(event);
    } catch (const std::exception& fault) {
        m_lastOutcome->fault = std::current_exception();
        trouble = QString::fromUtf8(fault.what());
    }
    m_view = m_driver.view();
    Q_EMIT viewChanged();
    if (m_lastOutcome->refusal)
        Q_EMIT told(QString::fromStdString(m_lastOutcome->refusal->reason), Tone::Refusal);
    else if (m_lastOutcome->fault)
        Q_EMIT told(trouble, Tone::Fault);
}

Correctable SessionController::correctableOf(const StoredAnswer& answer) const
{
    const auto& trial = plan().trials.at(static_cast<std::size_t>(answer.index));
    const auto& phase = plan().protocol.phases.at(static_cast<std::size_t>(trial.phase));
    Correctable found{phase.questions.at(static_cast<std::size_t>(answer.question)).id, {}, {}, phase.scale};
    if (const auto* rating = std::get_if<protocols::Tenths>(&answer.response)) {
        found.current = textOf(*rating);
        return found;
    }
    for (std::size_t place = 0; place < trial.alternatives.size(); ++place) {
        const protocols::FabricId& fabric = trial.alternatives[place];
        const auto named = plan().fabricNames.find(fabric);
        const std::string& fabricName = named == plan().fabricNames.end() ? fabric.value : named->second;
        found.choices.push_back({fabric, QStringLiteral("%1    %2").arg(slotLetter(place), QString::fromStdString(fabricName))});
        if (std::get<protocols::FabricId>(answer.response) == fabric)
            found.current = found.choices.back().name;
    }
    return found;
}

std::vector<Correctable> SessionController::correctables() const
{
    std::vector<Correctable> latest;
    const auto& answers = m_view.state.answers;
    for (auto answer = answers.rbegin(); answer != answers.rend(); ++answer) {
        Correctable one = correctableOf(*answer);
        const bool isKnown = std::any_of(latest.begin(), latest.end(),
                                         [&](const Correctable& other) { return other.question == one.question; });
        if (!isKnown)
            latest.push_back(std::move(one));
    }
    return latest;
}

SessionFacts SessionController::facts() const
{
    SessionFacts known{QString::fromStdString(m_view.participant), {}, {}};
    for (const std::string& item : plan().protocol.checklist)
        known.checklist.push_back(QString::fromStdString(item));
    for (const auto& phase : plan().protocol.phases)
        if (phase.scale) {
            known.scale = *phase.scale;
            break;
        }
    return known;
}

}  // namespace study::app
