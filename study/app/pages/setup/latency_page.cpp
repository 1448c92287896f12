#include "study/app/pages/setup/latency_page.h"

#include <QApplication>
#include <QKeyEvent>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>

#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

constexpr auto toneSignal = "tone", flashSignal = "flash";
constexpr int tickMs = 5;

}  // namespace

LatencyPage::LatencyPage(std::shared_ptr<session::Clock> clock, QWidget* parent)
    : QWidget(parent),
      m_clock(std::move(clock)),
      m_operator(field("latencyOperatorField", tr("Name of the operator"), this)),
      m_tone(mainButton("latencyToneButton", tr("Begin with the bell (Enter)"), this)),
      m_flash(button("latencyFlashButton", tr("Begin with a flash, without sound"), this)),
      m_try(button("latencyTryButton", tr("Ring the bell"), this)),
      m_back(plainButton("latencyBackButton", tr("Back (Esc)"), this)),
      m_lamp(label("latencyLamp", Type::Title, this, Weight::Bold)),
      m_progress(label("latencyProgress", Type::Lead, this)),
      m_message(new MessageBar("latencyMessage", this)),
      m_tick(new QTimer(this))
{
    setObjectName("latencyPage");
    setFocusPolicy(Qt::ClickFocus);
    m_tick->setTimerType(Qt::PreciseTimer);
    m_tick->setInterval(tickMs);
    build();
    connect(m_tone, &QPushButton::clicked, this, [this] { start(toneSignal); });
    connect(m_flash, &QPushButton::clicked, this, [this] { start(flashSignal); });
    connect(m_try, &QPushButton::clicked, this, [] { QApplication::beep(); });
    connect(m_back, &QPushButton::clicked, this, &LatencyPage::backRequested);
    connect(m_tick, &QTimer::timeout, this, &LatencyPage::attend);
}

void LatencyPage::build()
{
    auto* page = new QWidget(this);
    auto* head = new PageHead(page);
    head->setTexts(
        tr("Latency of the operator"),
        tr("Press the space bar, or your pedal, at each signal for two minutes. The report shows your median beside the "
           "times that your keys stamp. It subtracts nothing."));
    auto* about = quietLabel("latencyAbout", page);
    about->setText(
        tr("The bell is that of this computer. Ring it first. If you hear nothing, use the flash: then the lamp below "
           "turns bright. Esc stops the task, and nothing is stored."));
    auto* caption = quietLabel("latencyOperatorCaption", page);
    caption->setText(tr("Name of the operator"));
    m_operator->setMaximumWidth(420);
    m_lamp->setAlignment(Qt::AlignCenter);
    m_lamp->setMinimumHeight(m_lamp->fontMetrics().height() * 5);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addWidget(head);
    column->addWidget(about);
    column->addWidget(caption);
    column->addWidget(m_operator);
    column->addLayout(actionsRow({m_tone, m_flash, m_try, m_back}));
    column->addWidget(m_message);
    column->addWidget(m_progress);
    column->addWidget(m_lamp, 1);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("latencyArea", page, this));
    takeSignalAway();
}

void LatencyPage::present(const QString& operatorName)
{
    stop({});
    if (m_operator->text().trimmed().isEmpty()) m_operator->setText(operatorName);
    m_progress->setText({});
}

void LatencyPage::focusFirst() { m_tone->setFocus(); }

void LatencyPage::start(const char* signal)
{
    if (m_operator->text().trimmed().isEmpty()) {
        m_operator->setFocus();
        return m_message->showHint(tr("The name of the operator is missing. Type it, then begin."));
    }
    m_message->clearMessage();
    m_signal = signal;
    const std::int64_t nowNs = m_clock->monotonicNs();
    m_task.emplace(nowNs, static_cast<std::uint64_t>(nowNs));
    for (QWidget* control : {static_cast<QWidget*>(m_operator), static_cast<QWidget*>(m_tone), static_cast<QWidget*>(m_flash),
                             static_cast<QWidget*>(m_try)})
        control->setEnabled(false);
    setFocus();
    m_tick->start();
    attend();
}

void LatencyPage::stop(const QString& why)
{
    m_tick->stop();
    m_task.reset();
    takeSignalAway();
    for (QWidget* control : {static_cast<QWidget*>(m_operator), static_cast<QWidget*>(m_tone), static_cast<QWidget*>(m_flash),
                             static_cast<QWidget*>(m_try)})
        control->setEnabled(true);
    if (why.isEmpty())
        m_message->clearMessage();
    else
        m_message->showHint(why);
}

void LatencyPage::attend()
{
    if (!m_task) return;
    const std::int64_t nowNs = m_clock->monotonicNs();
    switch (m_task->advance(nowNs)) {
        case LatencyTask::Step::Wait:
            break;
        case LatencyTask::Step::GiveSignal:
            giveSignal();
            break;
        case LatencyTask::Step::Missed:
            takeSignalAway();
            break;
        case LatencyTask::Step::Done:
            return finish();
    }
    const QString text =
        tr("%1 s left  ·  taps: %2").arg(static_cast<int>(std::ceil(m_task->secondsLeft(nowNs)))).arg(m_task->taps());
    if (m_progress->text() != text) m_progress->setText(text);
}

void LatencyPage::giveSignal()
{
    if (m_signal == toneSignal) {
        QApplication::beep();
    } else {
        setRole(*m_lamp, "tag-new");
        m_lamp->setText(tr("Now"));
        m_lamp->repaint();  // the time of the signal is that of the drawn lamp
    }
    m_task->signalGiven(m_clock->monotonicNs());
}

void LatencyPage::takeSignalAway()
{
    setRole(*m_lamp, "tag");
    m_lamp->setText(tr("Wait"));
}

void LatencyPage::tap()
{
    const std::int64_t atNs = m_clock->monotonicNs();
    m_task->tap(atNs);
    takeSignalAway();
}

void LatencyPage::finish()
{
    database::OperatorLatency run = m_task->result();
    run.operatorName = m_operator->text().trimmed().toStdString();
    run.signal = m_signal;
    stop({});
    m_progress->setText({});
    if (run.taps == 0) return m_message->showHint(tr("No signal was answered, so nothing is stored. Begin again."));
    Q_EMIT measured(run);
}

void LatencyPage::showStored(const database::OperatorLatency& run)
{
    m_message->showDone(tr("Stored: median %1 ms, middle half from %2 to %3 ms, taps: %4, misses: %5, too early: %6.")
                            .arg(std::lround(run.medianMs.value_or(0)))
                            .arg(std::lround(run.q1Ms.value_or(0)))
                            .arg(std::lround(run.q3Ms.value_or(0)))
                            .arg(run.taps)
                            .arg(run.misses)
                            .arg(run.anticipations));
    m_back->setFocus();
}

void LatencyPage::showFault(const QString& text) { m_message->showFault(text); }

void LatencyPage::keyPressEvent(QKeyEvent* event)
{
    if (m_task) {
        if (event->isAutoRepeat()) return;
        if (event->key() == Qt::Key_Escape) return stop(tr("The task was stopped. Nothing is stored."));
        return tap();
    }
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        Q_EMIT backRequested();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()))
        start(toneSignal);
    else
        QWidget::keyPressEvent(event);
}

bool LatencyPage::focusNextPrevChild(bool next) { return m_task ? false : QWidget::focusNextPrevChild(next); }

void LatencyPage::hideEvent(QHideEvent* event)
{
    QWidget::hideEvent(event);
    if (m_task) stop({});
}

}  // namespace study::app
