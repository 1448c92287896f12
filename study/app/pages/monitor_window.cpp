#include "study/app/pages/monitor_window.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>

#include "study/app/language/below.h"
#include "study/app/monitoring/flag_reading.h"
#include "study/app/monitoring/server_monitor.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

constexpr int msBetweenUpdates = 2000;
constexpr int columnsOfDetails[] = {3, 5, 6, 7};  ///< presentation, missing, void, last event
constexpr int programColumn = 5;

QString sinceText(const std::optional<double>& minutes)
{
    if (!minutes) return {};
    if (*minutes < 1) return MonitorWindow::tr("just now");
    const int minutesInADay = 24 * 60;
    const long days = std::lround(*minutes / minutesInADay);
    if (*minutes >= minutesInADay) return days == 1 ? MonitorWindow::tr("1 day ago") : MonitorWindow::tr("%1 days ago").arg(days);
    return MonitorWindow::tr("%1 min ago").arg(static_cast<int>(*minutes));
}

QString signText(int seconds)
{
    const int secondsOfNow = 5, secondsInAMinute = 60;
    if (seconds < secondsOfNow || seconds >= secondsInAMinute) return sinceText(1.0 * seconds / secondsInAMinute);
    return MonitorWindow::tr("%1 s ago").arg(seconds);
}

QStringList cellsOf(const MonitorOverview::StationRow& station)
{
    using Contact = MonitorOverview::StationRow::Contact;
    const bool isConnected = station.contact == Contact::Connected;
    return {station.station,
            isConnected                        ? MonitorWindow::tr("connected")
            : station.contact == Contact::Lost ? MonitorWindow::tr("lost")
                                               : MonitorWindow::tr("unknown"),
            station.participant.isEmpty() ? QStringLiteral("–") : station.participant,
            station.secondsSinceSign ? signText(*station.secondsSinceSign) : QString(),
            isConnected                ? QString::number(station.waiting)
            : station.secondsSinceSign ? MonitorWindow::tr("%1 at that time").arg(station.waiting)
                                       : MonitorWindow::tr("may wait"),
            station.program};
}

/// "12/42", or "12" where the whole is unknown.
QString partText(int part, int whole)
{
    return whole > 0 ? MonitorWindow::tr("%1/%2").arg(part).arg(whole) : QString::number(part);
}

/// Changes the cells in place, so that the chosen row and the place of a scrolled table stay.
void fillTable(QTreeWidget& table, const std::vector<QStringList>& rows)
{
    const int count = static_cast<int>(rows.size());
    while (table.topLevelItemCount() > count) delete table.takeTopLevelItem(table.topLevelItemCount() - 1);
    for (int row = 0; row < count; ++row) {
        const QStringList& cells = rows[static_cast<std::size_t>(row)];
        QTreeWidgetItem* item = row < table.topLevelItemCount() ? table.topLevelItem(row) : new QTreeWidgetItem(&table);
        for (int column = 0; column < table.columnCount(); ++column) item->setText(column, cells.value(column));
    }
}

void buildTable(QTreeWidget& table, const char* objectName, const QString& accessibleName, const QStringList& columns)
{
    name(table, objectName, accessibleName);
    setType(table, Type::Plain);
    table.setRootIsDecorated(false);
    table.setAllColumnsShowFocus(true);
    table.setHeaderLabels(columns);
    table.header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table.header()->setFocusPolicy(Qt::NoFocus);
    setType(*table.header(), Type::Small);
    table.setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
}

QStringList cellsOf(const MonitorOverview::ParticipantRow& row)
{
    if (row.state == database::SlotState::Free)
        return {QString::number(row.place), QStringLiteral("–"), MonitorWindow::tr("free")};
    const bool isUnderWay = row.state == database::SlotState::Started;
    return {QString::number(row.place),
            row.participant,
            row.stage,
            isUnderWay && row.presentations > 0 ? partText(row.presentation, row.presentations) : QString(),
            partText(row.answers, row.answersInAll),
            row.missing > 0 ? QString::number(row.missing) : QString(),
            row.voided > 0 ? QString::number(row.voided) : QString(),
            sinceText(row.minutesSinceEvent)};
}

/// `hasMissing`: the table shows how many answers are missing.
QString footText(bool hasMissing)
{
    QStringList parts{MonitorWindow::tr("This window only reads the study. It updates every two seconds.")};
    if (hasMissing) parts << MonitorWindow::tr("Missing: answers to voided presentations that have not been repeated yet.");
    parts << MonitorWindow::tr("Close: Esc").replace(QLatin1Char(' '), QChar::Nbsp);
    return parts.join(QStringLiteral("   ·   "));
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
      m_clock(options.clock ? options.clock : std::make_shared<session::SystemClock>()),
      m_server(serverMonitorOf(study, m_clock, this)),
      m_appearanceKeys(new AppearanceKeys(options.settings, *this)),
      m_flagReading(new FlagReading(options.readFlags, this)),
      m_title(label("monitorTitle", Type::Title, this, Weight::Bold)),
      m_summary(label("monitorSummary", Type::Lead, this)),
      m_rows(new QTreeWidget(this)),
      m_stationsCaption(label("stationsCaption", Type::Lead, this, Weight::Bold)),
      m_stations(new QTreeWidget(this)),
      m_flagsCaption(label("flagsCaption", Type::Lead, this, Weight::Bold)),
      m_flags(label("flags", Type::Body, this)),
      m_hint(quietLabel("monitorHint", this, Type::Small)),
      m_message(new MessageBar("monitorMessage", this))
{
    setObjectName("monitorWindow");
    if (!m_server) m_store = readMonitored(study);
    buildTables();
    m_flagsCaption->setText(tr("Flags"));
    m_hint->setText(footText(false));

    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    for (QWidget* part : {static_cast<QWidget*>(m_title), static_cast<QWidget*>(m_summary), static_cast<QWidget*>(m_message)})
        column->addWidget(part);
    column->addWidget(m_rows, 3);
    column->addWidget(m_stationsCaption);
    column->addWidget(m_stations, 2);
    for (QWidget* part : {static_cast<QWidget*>(m_flagsCaption), static_cast<QWidget*>(m_flags), static_cast<QWidget*>(m_hint),
                          appearanceHint(page)})
        column->addWidget(part);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("monitorArea", page, this));
    const QSize frame(16, 40);  // the borders and the title that the desktop adds
    const QRect room = screen()->availableGeometry();
    resize(QSize(1100, 750).boundedTo(room.size() - frame));
    move(room.topLeft() + QPoint((room.width() - width()) / 2, (room.height() - height()) / 2));
    connect(m_flagReading, &FlagReading::done, this, &MonitorWindow::showFlags);
    connect(m_flagReading, &FlagReading::failed, m_flags, &QLabel::setText);
    if (m_server) connectServer();
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, &MonitorWindow::refresh);
    timer->start(msBetweenUpdates);
    refresh();
    m_rows->setFocus();
}

MonitorWindow::~MonitorWindow() = default;

void MonitorWindow::buildTables()
{
    buildTable(*m_rows, "monitorRows", tr("Stage of every participant"),
               {tr("Place"), tr("Participant"), tr("Stage"), tr("Presentation"), tr("Answers"), tr("Missing"), tr("Void"),
                tr("Last event")});
    m_stationsCaption->setText(tr("Stations"));
    buildTable(*m_stations, "stationRows", tr("Stations"),
               {tr("Station"), tr("Connection"), tr("Participant"), tr("Last sign of life"), tr("Entries that wait there"),
                tr("Program")});
    m_stations->setColumnHidden(programColumn, true);
    for (QWidget* part : {static_cast<QWidget*>(m_stationsCaption), static_cast<QWidget*>(m_stations)})
        part->setVisible(m_server != nullptr);
}

void MonitorWindow::connectServer()
{
    connect(m_server, &ServerMonitor::read, this, [this](const MonitorOverview& overview, const QString& fault) {
        present(overview);
        if (fault.isEmpty())
            m_message->clearMessage();
        else
            m_message->showFault(fault);
    });
}

void MonitorWindow::refresh()
{
    if (m_server) return m_server->refresh();
    try {
        present(monitorOverview(*m_store, m_clock->wallTime()));
        m_message->clearMessage();
    } catch (const std::exception& fault) {
        m_message->showFault(tr("%1. The window tries again in two seconds.").arg(inOwnLanguage(fault.what())));
    }
}

void MonitorWindow::present(const MonitorOverview& overview)
{
    readFlags(overview);
    if (m_shown == overview) return;
    if (overview.stations) presentStations(*overview.stations);
    presentRows(overview);
    m_shown = overview;
}

void MonitorWindow::readFlags(const MonitorOverview& overview)
{
    const auto open = m_server ? m_server->openLast() : FlagReading::Open([study = m_study] { return readMonitored(study); });
    for (QWidget* part : {static_cast<QWidget*>(m_flagsCaption), static_cast<QWidget*>(m_flags)})
        part->setVisible(static_cast<bool>(open));
    if (!open || overview.answers == m_answersAtFlags || m_flagReading->isUnderWay()) return;
    m_answersAtFlags = overview.answers;
    m_flagReading->begin(open);
}

void MonitorWindow::presentStations(const std::vector<MonitorOverview::StationRow>& stations)
{
    std::vector<QStringList> rows;
    bool isProgramKnown = false;
    for (const MonitorOverview::StationRow& station : stations) {
        rows.push_back(cellsOf(station));
        isProgramKnown = isProgramKnown || !station.program.isEmpty();
    }
    if (rows.empty()) rows.push_back({tr("none is connected")});
    fillTable(*m_stations, rows);
    m_stations->setColumnHidden(programColumn, !isProgramKnown);
    m_stations->setMinimumHeight(m_stations->fontMetrics().height() * 6);
}

void MonitorWindow::presentRows(const MonitorOverview& overview)
{
    if (m_shown && m_shown->rows == overview.rows && m_shown->study == overview.study &&
        m_shown->answersInAll == overview.answersInAll && m_shown->isBlinded == overview.isBlinded)
        return;
    setWindowTitle(tr("%1 – monitor – Vis2Hap").arg(overview.study));
    m_title->setText(overview.study);
    m_summary->setText(overview.isBlinded ? tr("%1 of %2 answers  ·  %3")
                                                .arg(overview.answers)
                                                .arg(overview.answersInAll)
                                                .arg(*overview.isBlinded ? tr("blinded") : tr("unblinded"))
                       : overview.rows.empty() ? QString()
                                               : tr("Answers: %1").arg(overview.answers));
    std::vector<QStringList> rows;
    for (const MonitorOverview::ParticipantRow& row : overview.rows) rows.push_back(cellsOf(row));
    fillTable(*m_rows, rows);
    for (const int column : columnsOfDetails) m_rows->setColumnHidden(column, !overview.isBlinded);
    m_hint->setText(footText(overview.isBlinded.has_value()));
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
