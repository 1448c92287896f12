// Owns the engine of one running session and stands between it and the pages: takes the events they ask
// for, keeps what came of the last one, and tells what may be shown. No page ever sees the plan, for
// that carries file codes.
#pragma once

#include "study/app/app_options.h"
#include "study/session/driver.h"

#include <QObject>
#include <QString>

#include <exception>
#include <optional>
#include <vector>

namespace study::app {

/// A stored answer that can still be corrected, as the correction panel shows it: the latest to its question.
struct Correctable {
    struct Choice {
        protocols::FabricId fabric;
        QString name;  ///< "A  Denim"
    };
    protocols::QuestionId question;
    QString current;                        ///< "B  Denim" or "5.5"
    std::vector<Choice> choices;            ///< of that presentation's tray; empty for ratings
    std::optional<protocols::Scale> scale;  ///< of ratings
};

/// What stays the same during a session and is shown at its start.
struct SessionFacts {
    QString participant;
    QStringList checklist;
    protocols::Scale scale;  ///< of the first rating question
};

/// What came of one event.
struct Outcome {
    session::EventBody event;
    std::optional<session::Refusal> refusal;
    std::exception_ptr fault;  ///< a protocols::Error thrown by disk or display
};

enum class Tone { Hint, Refusal, Fault };

class SessionController : public QObject {
    Q_OBJECT
public:
    /// Enrols the participant or finds where they were. Throws protocols::Error as Driver does.
    SessionController(database::StudyStore& store, const protocols::ParticipantId& participant,
                      rendering::StimulusBank& bank, std::unique_ptr<rendering::HapticDisplay> display,
                      std::shared_ptr<session::Clock> clock, database::ParticipantKind kind, QObject* parent);

    /// Never throws: refusals and faults are signalled, and kept in lastOutcome().
    void send(const session::EventBody& event);

    const session::View& view() const { return m_view; }
    const session::Plan& plan() const { return m_driver.plan(); }
    std::vector<Correctable> correctables() const;
    SessionFacts facts() const;

    /// Empty before the first event.
    const std::optional<Outcome>& lastOutcome() const { return m_lastOutcome; }
    int eventsSent() const { return m_eventsSent; }

Q_SIGNALS:
    void viewChanged();
    void told(const QString& text, study::app::Tone tone);

private:
    Correctable correctableOf(const session::StoredAnswer& answer) const;

    std::unique_ptr<rendering::HapticDisplay> m_display;
    std::shared_ptr<session::Clock> m_clock;
    session::Driver m_driver;
    session::View m_view;
    std::optional<Outcome> m_lastOutcome;
    int m_eventsSent = 0;
};

}  // namespace study::app
