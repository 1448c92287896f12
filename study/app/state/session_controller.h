// Owns the engine of one running session and connects it to the pages. It sends the events that the pages request, keeps the
// last outcome, and provides the view. No page sees the plan, because the plan contains file codes.
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
#include "study/app/state/tried_display.h"
#include "study/session/driver.h"

namespace study::app {

/// A stored answer that can be corrected: the latest answer to its question, as the correction panel shows it.
struct Correctable {
    protocols::QuestionId question;
    QString current;  ///< "B    Piece 427", "5.5"
    AnswerForm form;  ///< form of an answer to that presentation
    session::GivenAnswer response;
};

/// Answers that count, as the study page counts them. The repetition of a voided presentation replaces its answers.
struct AnswerCount {
    int given = 0;  ///< so far
    int inAll = 0;  ///< at the end of the session
};
inline AnswerCount countedAnswers(const session::View& view)
{
    const int given = static_cast<int>(view.state.answers.size());
    return {given, given + view.answersInAll - view.answersStored};
}

/// "Q1", "Q2–Q4". No id of a question has a dash of its own.
inline QString phaseText(const session::View& view)
{
    return QString::fromStdString(view.phaseName).replace(QLatin1Char('-'), QStringLiteral("–"));
}

/// Why an event was sent. A display that fails between two events pauses the session. What the participant did on their own page
/// is no step of the operator.
enum class Cause { Usual, DisplayFault, Participant };

/// Result of one event: accepted, refused or failed.
struct EventOutcome {
    session::EventBody event;
    std::optional<session::Refusal> refusal;
    std::exception_ptr fault;  ///< a protocols::Error thrown by disk or display
    Cause cause = Cause::Usual;
};

enum class Tone { Done, Hint, Refusal, Fault };

/// What a page says about a key that may have bounced.
QString bouncedKeyText();

class SessionController : public QObject {
    Q_OBJECT
public:
    /// Enrols the participant or restores the session. Throws the errors of Driver.
    SessionController(database::SessionStore& store, const protocols::ParticipantId& participant,
                      rendering::PresentedImages& images, std::unique_ptr<rendering::HapticDisplay> display,
                      std::shared_ptr<session::Clock> clock, database::ParticipantKind kind,
                      const session::OperatedBy& operatedBy, QObject* parent);
    ~SessionController() override;

    /// Sends the event to the engine. Never throws: refusals and faults are reported by signal and kept in lastOutcome().
    /// A confirmation within the protocol's dead time after the operator's last step is refused here: its key may have bounced.
    void send(const session::EventBody& event);
    /// The same for an act of the participant on their own page. Nothing confirms it to the operator as an entry of theirs.
    void sendOfParticipant(const session::EventBody& event);
    /// Stamps the first touch if the presentation waits for one; otherwise does nothing.
    void displayTouched(const rendering::Touch& touch = {});
    /// Stamps the beginning of the present answer now, if the entry or the spoken word has no stamp yet. The answer takes the
    /// earlier of both stamps.
    void markAnswerBegun(session::BegunBy by);
    /// Shows a test pattern while the checklist is open, or clears it (none). Never throws: faults are reported by signal.
    /// Every event clears the pattern first.
    void showPattern(const std::optional<TestPattern>& pattern, std::optional<double> mmPerPixel);
    /// Takes back the stamp that the first key of an entry made. That of the spoken word stays.
    void unmarkEntry();
    /// Counts the times of view() to now; they are those of the last event. Reports a log that cannot be read. Never throws.
    void refresh();
    /// The page showed a hint, which may ask for a second Enter. A bounced key must not be the second one.
    void pageAsked();
    /// The next event is not a bounced key. A script waits as long as a person does, but its clock may stand still.
    void waitOutDeadTime();
    /// The stamps of the next answer, as a script states them.
    void setStamps(const session::AnswerStamps& stamps) { m_scriptedStamps = stamps; }

    const session::View& view() const { return m_view; }
    const session::Plan& plan() const { return m_driver.plan(); }
    /// The latest answer to every question, the most recent first.
    std::vector<Correctable> correctables() const;
    bool canCorrect() const;
    SessionFacts facts() const;

    /// Empty before the first event.
    const std::optional<EventOutcome>& lastOutcome() const { return m_lastOutcome; }
    int eventsSent() const { return m_eventsSent; }

Q_SIGNALS:
    void viewChanged();
    void patternShown(const std::optional<rendering::TestPattern>& pattern);
    void reported(const QString& text, study::app::Tone tone);

private:
    void sendFor(Cause cause, const session::EventBody& event);
    const protocols::Question& questionOf(const session::StoredAnswer& answer) const;
    Correctable correctableOf(const session::StoredAnswer& answer) const;
    bool isBounced(const session::EventBody& event) const;
    void clearPattern();
    QString takeView();
    /// `trouble`: of the event; `unread`: why the head of the log cannot be read after it. Both may be empty.
    void reportOutcome(const QString& trouble, const QString& unread);
    void watchDisplay();
    void attendDisplay();
    void displayReleased(const rendering::Touch& release);
    session::AnswerStamps stampsNow(const session::AnswerStamps& fromPage) const;
    void forgetStamps();

    std::unique_ptr<rendering::HapticDisplay> m_display;
    std::unique_ptr<QSocketNotifier> m_watch;  ///< declared after the display, so destroyed before it
    std::shared_ptr<session::Clock> m_clock;
    session::Driver m_driver;
    session::View m_view;
    std::optional<std::int64_t> m_entryAtNs, m_spokenAtNs, m_releasedAtNs;  ///< of the present question
    std::optional<session::AnswerStamps> m_scriptedStamps;
    std::optional<std::int64_t> m_lastStepAtNs;  ///< the operator opened the session or made the last accepted entry
    std::optional<std::int64_t> m_askedAtNs;     ///< the page showed its last hint
    std::optional<TestPattern> m_pattern;        ///< that can be felt
    std::optional<EventOutcome> m_lastOutcome;
    int m_eventsSent = 0;
};

}  // namespace study::app
