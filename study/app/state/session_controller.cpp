#include "study/app/state/session_controller.h"

#include <algorithm>

#include "protocols/answer_kind.h"
#include "protocols/files/errors.h"
#include "study/app/language/below.h"

namespace study::app {

using session::StoredAnswer;

namespace {

constexpr char tooSoon[] = "The last step was only just taken, so this key confirmed nothing. Press it again.";

/// Confirms an action that changes nothing else on the page.
QString confirmationOf(const session::EventBody& event)
{
    const auto* noted = std::get_if<session::Noted>(&event);
    if (noted)
        return noted->isFlag ? SessionController::tr("The presentation is flagged.")
                             : SessionController::tr("The note is stored.");
    if (std::holds_alternative<session::Corrected>(event))
        return SessionController::tr("The answer is corrected. The study keeps the old answer.");
    if (std::holds_alternative<session::Voided>(event))
        return SessionController::tr("The presentation is void. It will be repeated under another code.");
    return {};
}

QString withNextStep(const QString& trouble, bool isPaused)
{
    return isPaused
               ? SessionController::tr(
                     "%1. The session is paused and no answer is lost. Fix the problem, then press Enter "
                     "to continue.")
                     .arg(trouble)
               : SessionController::tr("%1. Your last entry was not stored. Fix the problem, then enter it again.").arg(trouble);
}

template <class... Bodies>
bool isOneOf(const session::EventBody& event)
{
    return (std::holds_alternative<Bodies>(event) || ...);
}

/// The operator confirms the page in front, and another page follows.
bool confirmsPage(const session::EventBody& event)
{
    using namespace session;
    return isEnteredByOperator(event) &&
           isOneOf<Begun, Consented, FactsGiven, FamiliarisationDone, ScaleTrainingDone, ChecklistDone, SittingPrepared,
                   TrayReady, BreakEnded, Resumed, Debriefed>(event);
}

bool hasNoWords(const session::GivenAnswer& response)
{
    const auto* words = std::get_if<session::Words>(&response);
    return words && words->text.empty();
}

/// The page may have asked for a second Enter: a text is empty, a reading is doubtful, or the participant had not agreed. It also
/// asks where an answer was typed before the tray was confirmed.
bool mayNeedSecondEnter(const session::EventBody& event)
{
    return std::visit(
        protocols::Overloaded{
            [](const session::Answered& answered) { return hasNoWords(answered.response); },
            [](const session::Corrected& corrected) { return corrected.why.empty() || hasNoWords(corrected.response); },
            [](const session::WithdrawnEvent& withdrawn) { return withdrawn.why.empty(); },
            [](const session::Consented& consented) { return consented.by == session::EnteredBy::Operator; },
            [](const session::TrayReady&) { return true; }, [](const session::ChecklistDone&) { return true; },
            [](const auto&) { return false; }},
        event);
}

bool isStepOfOperator(const session::EventBody& event)
{
    return session::isEnteredByOperator(event) && !std::holds_alternative<session::Touched>(event);
}

/// Whether another question, or none, is asked now.
bool isOtherQuestion(const session::Stage& before, const session::Stage& now)
{
    const auto* old = std::get_if<session::Presenting>(&before);
    const auto* asked = std::get_if<session::Presenting>(&now);
    return !old || !asked || old->index != asked->index || old->question != asked->question || old->readyAtNs != asked->readyAtNs;
}

}  // namespace

QString bouncedKeyText() { return inOwnLanguage(tooSoon); }

SessionController::SessionController(database::SessionStore& store, const protocols::ParticipantId& participant,
                                     rendering::PresentedImages& images, std::unique_ptr<rendering::HapticDisplay> display,
                                     std::shared_ptr<session::Clock> clock, database::ParticipantKind kind,
                                     const session::OperatedBy& operatedBy, QObject* parent)
    : QObject(parent),
      m_display(std::move(display)),
      m_clock(std::move(clock)),
      m_driver(store, participant, kind, images, *m_display, *m_clock, operatedBy),
      m_view(m_driver.view()),
      m_lastStepAtNs(m_clock->monotonicNs())
{
    m_display->onTouched([this](const rendering::Touch& touch) { displayTouched(touch); });
    m_display->onReleased([this](const rendering::Touch& release) { displayReleased(release); });
    m_display->onFinger([this](const rendering::FingerReport& report) { m_driver.addFinger(report); });
    watchDisplay();
}

SessionController::~SessionController()
{
    try {
        if (m_pattern) m_display->clear();
    } catch (const std::exception&) {
        // The display is closed next, and then a driver clears its device.
    }
}

void SessionController::clearPattern()
{
    if (!m_pattern) return;
    m_display->clear();
    m_pattern.reset();
    Q_EMIT patternShown(std::nullopt);
}

void SessionController::showPattern(const std::optional<TestPattern>& pattern, std::optional<double> mmPerPixel)
{
    const bool isInTheList = std::holds_alternative<session::CheckingList>(m_view.state.stage) && !m_view.state.paused;
    try {
        clearPattern();
        if (pattern && isInTheList) {
            const cv::Mat image = rendering::testPatternImage(*pattern, m_display->surfacePx(), mmPerPixel);
            m_pattern = pattern;  // A display that fails may show the image nevertheless.
            m_display->show(image);
            Q_EMIT patternShown(m_pattern);
        }
    } catch (const std::exception& fault) {
        const QString trouble = inOwnLanguage(fault.what());
        try {
            clearPattern();
        } catch (const std::exception&) {
            // Report the first fault of the display; later ones are consequences. The next event clears it again.
        }
        Q_EMIT patternShown(m_pattern);
        Q_EMIT reported(trouble, Tone::Fault);
    }
}

void SessionController::watchDisplay()
{
    if (m_display->descriptorToWatch() < 0) return;
    m_watch = std::make_unique<QSocketNotifier>(m_display->descriptorToWatch(), QSocketNotifier::Read);
    connect(m_watch.get(), &QSocketNotifier::activated, this, [this] { attendDisplay(); });
}

void SessionController::attendDisplay()
{
    try {
        m_display->processMessages();
    } catch (const std::exception& fault) {
        // The participant may have felt a wrong image, so the presentation begins again after the pause.
        sendFor(Cause::DisplayFault, session::Paused{});
        Q_EMIT reported(withNextStep(inOwnLanguage(fault.what()), m_view.state.paused), Tone::Fault);
    }
}

/// The rule is not part of the engine, which must accept the older logs that it replays.
bool SessionController::isBounced(const session::EventBody& event) const
{
    const session::State& state = m_view.state;
    const std::int64_t nowNs = m_clock->monotonicNs();
    const bool isNewTray =
        std::holds_alternative<session::PlacingTray>(state.stage) && nowNs - state.trayAskedAtNs < state.deadTimeNs;
    if (isNewTray && std::holds_alternative<session::TrayReady>(event)) return false;  // the engine says more about it
    const auto isJustAfter = [&](const std::optional<std::int64_t>& atNs) { return atNs && nowNs - *atNs < state.deadTimeNs; };
    return (confirmsPage(event) && isJustAfter(m_lastStepAtNs)) || (mayNeedSecondEnter(event) && isJustAfter(m_askedAtNs));
}

void SessionController::refresh()
{
    // A store tells only once that its files were displaced.
    if (const QString why = takeView(); !why.isEmpty()) Q_EMIT reported(why, Tone::Fault);
}

/// Takes the present view, and returns why the head of the log could not be read; else an empty text.
QString SessionController::takeView()
{
    try {
        m_view = m_driver.view();
        return {};
    } catch (const std::exception& fault) {
        const QString why = inOwnLanguage(fault.what());
        try {
            m_view = m_driver.view();  // a store whose files were displaced has the head of the rescue file now
        } catch (const std::exception&) {
            m_view = m_driver.viewWithoutHead();
        }
        return why;
    }
}

void SessionController::pageAsked() { m_askedAtNs = m_clock->monotonicNs(); }

void SessionController::waitOutDeadTime()
{
    m_lastStepAtNs.reset();
    m_askedAtNs.reset();
}

void SessionController::send(const session::EventBody& event) { sendFor(Cause::Usual, event); }

void SessionController::sendOfParticipant(const session::EventBody& event) { sendFor(Cause::Participant, event); }

void SessionController::sendFor(Cause cause, const session::EventBody& asked)
{
    session::EventBody event = asked;
    if (auto* answered = std::get_if<session::Answered>(&event)) answered->stamps = stampsNow(answered->stamps);
    const auto askedBefore = m_view.state.stage;
    m_lastOutcome = EventOutcome{event, std::nullopt, nullptr, cause};
    ++m_eventsSent;
    QString trouble;
    try {
        if (m_pattern && std::holds_alternative<session::Paused>(event)) {
            m_pattern.reset();  // A pause clears the display itself, and must not fail here.
            Q_EMIT patternShown(std::nullopt);
        } else
            clearPattern();  // The pattern must not be felt after the checklist.
        m_lastOutcome->refusal = isBounced(event) ? session::Refusal{tooSoon} : m_driver.send(event);
    } catch (const std::exception& fault) {
        m_lastOutcome->fault = std::current_exception();
        trouble = inOwnLanguage(fault.what());
    }
    const QString unread = takeView();
    const bool isStep = cause != Cause::Participant && isStepOfOperator(event);
    if (!m_lastOutcome->refusal && isStep) m_lastStepAtNs = m_clock->monotonicNs();
    if (isOtherQuestion(askedBefore, m_view.state.stage)) forgetStamps();
    Q_EMIT viewChanged();
    reportOutcome(trouble, unread);
}

void SessionController::reportOutcome(const QString& trouble, const QString& unread)
{
    const auto& event = m_lastOutcome->event;
    if (m_lastOutcome->refusal)
        Q_EMIT reported(inOwnLanguage(m_lastOutcome->refusal->reason), Tone::Refusal);
    else if (m_lastOutcome->fault)
        Q_EMIT reported(withNextStep(trouble, m_view.state.paused), Tone::Fault);
    else if (!unread.isEmpty())
        Q_EMIT reported(
            tr("Your last entry was stored. After it the head of the log could not be read: %1. Fix the problem, then "
               "go on.")
                .arg(unread),
            Tone::Fault);
    else if (const QString done = confirmationOf(event); !done.isEmpty() && m_lastOutcome->cause != Cause::Participant)
        Q_EMIT reported(done, Tone::Done);
}

void SessionController::displayTouched(const rendering::Touch& touch)
{
    const auto* presenting = std::get_if<session::Presenting>(&m_view.state.stage);
    if (presenting && !presenting->touchedAtNs) send(session::Touched{session::TouchSource::Display, touch.ago.count()});
}

void SessionController::displayReleased(const rendering::Touch& release)
{
    if (std::holds_alternative<session::Presenting>(m_view.state.stage))
        m_releasedAtNs = m_clock->monotonicNs() - release.ago.count();
}

void SessionController::markAnswerBegun(session::BegunBy by)
{
    auto& stamp = by == session::BegunBy::Spoken ? m_spokenAtNs : m_entryAtNs;
    if (!stamp && std::holds_alternative<session::Presenting>(m_view.state.stage)) stamp = m_clock->monotonicNs();
}

void SessionController::unmarkEntry() { m_entryAtNs.reset(); }

session::AnswerStamps SessionController::stampsNow(const session::AnswerStamps& fromPage) const
{
    if (m_scriptedStamps) return *m_scriptedStamps;
    session::AnswerStamps stamps = fromPage;
    const std::int64_t nowNs = m_clock->monotonicNs();
    const bool isSpokenFirst = m_spokenAtNs && (!m_entryAtNs || *m_spokenAtNs <= *m_entryAtNs);
    const auto& begunAtNs = isSpokenFirst ? m_spokenAtNs : m_entryAtNs;
    if (begunAtNs) stamps.begunAgoNs = nowNs - *begunAtNs;
    stamps.begunBy = isSpokenFirst ? session::BegunBy::Spoken : session::BegunBy::Entry;
    if (m_releasedAtNs) stamps.touchEndedAgoNs = nowNs - *m_releasedAtNs;
    return stamps;
}

void SessionController::forgetStamps()
{
    m_entryAtNs.reset();
    m_spokenAtNs.reset();
    m_releasedAtNs.reset();
    m_scriptedStamps.reset();
}

const protocols::Question& SessionController::questionOf(const StoredAnswer& answer) const
{
    const auto& trial = plan().trials.at(static_cast<std::size_t>(answer.index));
    return plan()
        .protocol.phases.at(static_cast<std::size_t>(trial.phase))
        .questions.at(static_cast<std::size_t>(answer.question));
}

Correctable SessionController::correctableOf(const StoredAnswer& answer) const
{
    const auto& trial = plan().trials.at(static_cast<std::size_t>(answer.index));
    std::vector<std::string> pieces;
    for (const protocols::FabricId& fabric : trial.alternatives) pieces.push_back(session::nameIn(plan().fabricNames, fabric));
    const auto& question = questionOf(answer);
    Correctable found{question.id, {}, formOf(question.kind, trial.alternatives, pieces), answer.response};
    readBackInWords(found.form, QString::fromStdString(participantText(plan().protocol, "spoken_same")),
                    QString::fromStdString(participantText(plan().protocol, "spoken_different")));
    found.current = textOf(found.form, answer.response);
    return found;
}

std::vector<Correctable> SessionController::correctables() const
{
    std::vector<Correctable> latest;
    const auto& answers = m_view.state.answers;
    for (auto answer = answers.rbegin(); answer != answers.rend(); ++answer) {
        const protocols::QuestionId& question = questionOf(*answer).id;
        const bool isKnown =
            std::any_of(latest.begin(), latest.end(), [&](const Correctable& other) { return other.question == question; });
        if (!isKnown) latest.push_back(correctableOf(*answer));
    }
    return latest;
}

bool SessionController::canCorrect() const
{
    const session::Stage& stage = m_view.state.stage;
    const bool isOver = std::holds_alternative<session::Finished>(stage) || std::holds_alternative<session::Withdrawn>(stage);
    return !isOver && !m_view.state.answers.empty();
}

QString strokeText(const SessionFacts& facts)
{
    if (facts.strokeWords.isEmpty()) return {};
    return SessionController::tr("Say if needed: “%1”").arg(facts.strokeWords);
}

SessionFacts SessionController::facts() const
{
    const auto listOf = [](const std::vector<std::string>& texts) {
        QStringList list;
        for (const std::string& text : texts) list << QString::fromStdString(text);
        return list;
    };
    const protocols::Protocol& protocol = plan().protocol;
    const protocols::RatingScale* scale = memorisedScaleOf(protocol);
    protocols::TextsByKey said;
    for (const auto& [key, text] : protocols::usualParticipantTexts()) said[key] = participantText(protocol, key);
    return {.participant = QString::fromStdString(m_view.participant),
            .consent = QString::fromStdString(protocol.consent),
            .facts = listOf(protocol.facts),
            .checklist = listOf(protocol.checklist),
            .readings = listOf(protocol.readings),
            .strokeWords = QString::fromStdString(protocol.strokeWords),
            .scale = scale ? std::optional(*scale) : std::nullopt,
            .sittingMinutes = protocol.sittingMinutes,
            .secondEntry = protocol.secondEntry,
            .confirmPieces = protocol.confirmPieces,
            .displayReportsTouches = m_display->reportsTouches(),
            .displayTakesTickets = m_display->fetchesImages(),
            .displayName = m_display->isThere() ? QString::fromStdString(m_display->name()) : QString(),
            .said = std::move(said),
            .hasOwnLowEnd = hasOwnText(protocol, "card_low", "scale_low"),
            .hasOwnHighEnd = hasOwnText(protocol, "card_high", "scale_high")};
}

}  // namespace study::app
