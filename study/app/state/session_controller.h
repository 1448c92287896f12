// Owns the engine of one running session and stands between it and the pages: takes the events they ask
// for, keeps what came of the last one, and tells what may be shown. No page ever sees the plan, for
// that carries file codes.
#pragma once

#include <QObject>
#include <QSocketNotifier>
#include <QString>
#include <exception>
#include <optional>
#include <vector>

#include "study/app/state/answer_form.h"
#include "study/app/state/app_options.h"
#include "study/app/state/session_facts.h"
#include "study/session/driver.h"

namespace study::app {

/// A stored answer that can still be corrected, as the correction panel shows it: the latest to its question.
struct Correctable {
    protocols::QuestionId question;
    QString current;  ///< "B    Piece 427", "5.5"
    AnswerForm form;  ///< of that presentation
};

/// What came of one event.
struct EventOutcome {
    session::EventBody event;
    std::optional<session::Refusal> refusal;
    std::exception_ptr fault;  ///< a protocols::Error thrown by disk or display
};

enum class Tone { Done, Hint, Refusal, Fault };

class SessionController : public QObject {
    Q_OBJECT
public:
    /// Enrols the participant or finds where they were. Throws protocols::Error as Driver does.
    SessionController(database::StudyStore& store, const protocols::ParticipantId& participant, rendering::StimulusBank& bank,
                      std::unique_ptr<rendering::HapticDisplay> display, std::shared_ptr<session::Clock> clock,
                      database::ParticipantKind kind, QObject* parent);

    /// Never throws: refusals and faults are signalled, and kept in lastOutcome().
    void send(const session::EventBody& event);
    /// The display was touched: stamps the first touch where one is awaited, else nothing.
    void displayTouched(const rendering::Touch& touch = {});

    const session::View& view() const { return m_view; }
    const session::Plan& plan() const { return m_driver.plan(); }
    /// The last answer first.
    std::vector<Correctable> correctables() const;
    bool canCorrect() const;
    SessionFacts facts() const;

    /// Empty before the first event.
    const std::optional<EventOutcome>& lastOutcome() const { return m_lastOutcome; }
    int eventsSent() const { return m_eventsSent; }

Q_SIGNALS:
    void viewChanged();
    void reported(const QString& text, study::app::Tone tone);

private:
    const protocols::Question& questionOf(const session::StoredAnswer& answer) const;
    Correctable correctableOf(const session::StoredAnswer& answer) const;
    void reportOutcome(const QString& trouble);
    void watchDisplay();
    void attendDisplay();

    std::unique_ptr<rendering::HapticDisplay> m_display;
    std::unique_ptr<QSocketNotifier> m_watch;  ///< goes before what it watches
    std::shared_ptr<session::Clock> m_clock;
    session::Driver m_driver;
    session::View m_view;
    std::optional<EventOutcome> m_lastOutcome;
    int m_eventsSent = 0;
};

}  // namespace study::app
