#include "study/app/pages/monitor_window.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>

#include "study/app/language/below.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/flag_reading.h"

namespace study::app {

namespace {

constexpr int msBetweenUpdates = 2000;

QString sinceText(const std::optional<double>& minutes)
{
    if (!minutes) return {};
    if (*minutes < 1) return MonitorWindow::tr("just now");
    const int minutesInADay = 24 * 60;
    const long days = std::lround(*minutes / minutesInADay);
    if (*minutes >= minutesInADay) return days == 1 ? MonitorWindow::tr("1 day ago") : MonitorWindow::tr("%1 days ago").arg(days);
    return MonitorWindow::tr("%1 min ago").arg(static_cast<int>(*minutes));
}

QStringList cellsOf(const MonitorOverview::ParticipantRow& row)
{
    if (row.state == database::SlotState::Free)
        return {QString::number(row.place), QStringLiteral("–"), MonitorWindow::tr("free")};
    const bool isUnderWay = row.state == database::SlotState::Started;
    return {QString::number(row.place),
            row.participant,
            row.stage,
            isUnderWay ? MonitorWindow::tr("%1/%2").arg(row.presentation).arg(row.presentations) : QString(),
            MonitorWindow::tr("%1/%2").arg(row.answers).arg(row.answersInAll),
            row.missing > 0 ? QString::number(row.missing) : QString(),
            row.voided > 0 ? QString::number(row.voided) : QString(),
            sinceText(row.minutesSinceEvent)};
}

QString sentenceOf(const MonitorFlag& flag)
{
    const QString name = inOwnLanguage(flag.flag).replace(QLatin1Char('_'), QLatin1Char(' '));
    const QString why = inOwnLanguage(flag.why);
    if (flag.participant.empty()) return QStringLiteral("%1: %2").arg(name, why);
    return QStringLiteral("%1, %2: %3").arg(QString::fromStdString(flag.participant), name, why);
}

}  // namespace

MonitorWindow::MonitorWindow(const std::filesystem::path& study, const AppOptions& options, QWidget* parent)
    : QWidget(parent),
      m_study(study),
      m_store(readMonitored(study)),
      m_clock(options.clock ? options.clock : std::make_shared<session::SystemClock>()),
      m_appearanceKeys(new AppearanceKeys(options.settings, *this)),
      m_flagReading(new FlagReading(options.readFlags, study, this)),
      m_title(label("monitorTitle", Type::Title, this, Weight::Bold)),
      m_summary(label("monitorSummary", Type::Lead, this)),
      m_rows(new QTreeWidget(this)),
      m_flagsCaption(label("flagsCaption", Type::Lead, this, Weight::Bold)),
      m_flags(label("flags", Type::Body, this)),
      m_message(new MessageBar("monitorMessage", this))
{
    setObjectName("monitorWindow");
    name(*m_rows, "monitorRows", tr("Stage of every participant"));
    setType(*m_rows, Type::Plain);
    m_rows->setRootIsDecorated(false);
    m_rows->setAllColumnsShowFocus(true);
    m_rows->setHeaderLabels({tr("Place"), tr("Participant"), tr("Stage"), tr("Presentation"), tr("Answers"), tr("Missing"),
                             tr("Void"), tr("Last event")});
    m_rows->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_rows->header()->setFocusPolicy(Qt::NoFocus);
    m_flagsCaption->setText(tr("Flags"));
    auto* hint = quietLabel("monitorHint", this, Type::Small);
    hint->setText(
        tr("This window only reads the study. It updates every two seconds.   ·   Missing: answers to voided "
           "presentations that have not been repeated yet.   ·   Close: Esc"));

    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    for (QWidget* part : {static_cast<QWidget*>(m_title), static_cast<QWidget*>(m_summary), static_cast<QWidget*>(m_message)})
        column->addWidget(part);
    column->addWidget(m_rows, 1);
    for (QWidget* part : {static_cast<QWidget*>(m_flagsCaption), static_cast<QWidget*>(m_flags), static_cast<QWidget*>(hint),
                          appearanceHint(page)})
        column->addWidget(part);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("monitorArea", page, this));
    resize(1100, 750);
    connect(m_flagReading, &FlagReading::done, this, &MonitorWindow::showFlags);
    connect(m_flagReading, &FlagReading::failed, m_flags, &QLabel::setText);
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, &MonitorWindow::refresh);
    timer->start(msBetweenUpdates);
    refresh();
    m_rows->setFocus();
}

MonitorWindow::~MonitorWindow() = default;

void MonitorWindow::refresh()
{
    try {
        if (!m_store.serverFolder().empty()) m_store = readMonitored(m_study);  // a copy does not follow the server
        present(monitorOverview(m_store, m_clock->wallTime()));
        m_message->clearMessage();
    } catch (const std::exception& fault) {
        m_message->showFault(tr("%1. The window tries again in two seconds.").arg(inOwnLanguage(fault.what())));
    }
}

void MonitorWindow::present(const MonitorOverview& overview)
{
    if (overview.answers != m_answersAtFlags && !m_flagReading->isUnderWay()) {
        m_answersAtFlags = overview.answers;
        m_flagReading->begin();
    }
    if (m_shown == overview) return;
    m_shown = overview;
    setWindowTitle(tr("%1 – monitor – Vis2Hap").arg(overview.study));
    m_title->setText(overview.study);
    m_summary->setText(tr("%1 of %2 answers  ·  %3")
                           .arg(overview.answers)
                           .arg(overview.answersInAll)
                           .arg(overview.isBlinded ? tr("blinded") : tr("unblinded")));
    const int chosen = m_rows->indexOfTopLevelItem(m_rows->currentItem());
    m_rows->clear();
    for (const MonitorOverview::ParticipantRow& row : overview.rows) new QTreeWidgetItem(m_rows, cellsOf(row));
    m_rows->setCurrentItem(m_rows->topLevelItem(chosen));
    m_rows->setMinimumHeight(m_rows->fontMetrics().height() * 9);
}

void MonitorWindow::showFlags(const std::vector<MonitorFlag>& flags)
{
    QStringList sentences;
    for (const MonitorFlag& flag : flags) sentences << sentenceOf(flag);
    m_flags->setText(sentences.isEmpty() ? tr("None so far.") : sentences.join(QLatin1Char('\n')));
}

void MonitorWindow::keyPressEvent(QKeyEvent* event)
{
    const bool isClosing =
        event->key() == Qt::Key_Escape || (event->key() == Qt::Key_Q && event->modifiers().testFlag(Qt::ControlModifier));
    if (isClosing)
        close();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
