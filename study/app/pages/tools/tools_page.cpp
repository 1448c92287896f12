#include "study/app/pages/tools/tools_page.h"

#include <QDesktopServices>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPlainTextEdit>
#include <QUrl>
#include <QVBoxLayout>
#include <stdexcept>

#include "study/app/language/below.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

ToolsPage::ToolsPage(UseTool use, QWidget* parent)
    : QWidget(parent),
      m_use(std::move(use)),
      m_into(field("toolsFolderField", tr("Folder for new files"), this)),
      m_browse(button("toolsBrowseButton", tr("Browse…"), this)),
      m_monitor(button("toolMonitorButton", tr("Live monitor (M)"), this)),
      m_open(button("toolOpenButton", tr("Open what was made (O)"), this)),
      m_back(plainButton("toolsBackButton", tr("Back (Esc)"), this)),
      m_text(new QPlainTextEdit(this)),
      m_message(new MessageBar("toolsMessage", this))
{
    setObjectName("toolsPage");
    const auto add = [this](StudyTool tool, int key, const char* objectName, const QString& text) {
        auto* made = button(objectName, text, this);
        m_tools.push_back({tool, key, made});
        connect(made, &QPushButton::clicked, this, [this, tool] { this->use(tool); });
        return made;
    };
    auto* page = new QWidget(this);
    auto* title = label("toolsTitle", Type::Title, page, Weight::Bold);
    title->setText(tr("Tools of the study"));
    auto* reading = label("toolsReading", Type::Lead, page, Weight::Bold);
    reading->setText(tr("Look"));
    auto* look = actionsRow({add(StudyTool::Status, Qt::Key_S, "toolStatusButton", tr("Status (S)")),
                             add(StudyTool::Verify, Qt::Key_V, "toolVerifyButton", tr("Verify the study (V)")), m_monitor});
    auto* writing = label("toolsWriting", Type::Lead, page, Weight::Bold);
    writing->setText(tr("Write into a folder"));
    auto* hint = quietLabel("toolsHint", page, Type::Plain);
    hint->setText(tr("Each button makes a new file or folder there. Nothing that exists is overwritten."));
    auto* write = actionsRow({add(StudyTool::Sheets, Qt::Key_P, "toolSheetsButton", tr("Sheets to print (P)")),
                              add(StudyTool::Backup, Qt::Key_B, "toolBackupButton", tr("Backup (B)")),
                              add(StudyTool::Export, Qt::Key_E, "toolExportButton", tr("Export (E)")),
                              add(StudyTool::Report, Qt::Key_R, "toolReportButton", tr("Report (R)")),
                              add(StudyTool::DataSheet, Qt::Key_D, "toolDataSheetButton", tr("Data sheet (D)"))});
    name(*m_text, "toolResult", tr("Result"));
    setType(*m_text, Type::Plain);
    setRole(*m_text, "table");
    m_text->setReadOnly(true);
    m_text->setTabChangesFocus(true);

    auto* folder = new QHBoxLayout;
    folder->addWidget(m_into, 1);
    folder->addWidget(m_browse);
    auto* bottom = new QHBoxLayout;
    bottom->addWidget(m_back);
    bottom->addWidget(m_open);
    bottom->addStretch(1);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addWidget(title);
    column->addWidget(reading);
    column->addLayout(look);
    column->addWidget(writing);
    column->addWidget(hint);
    column->addLayout(folder);
    column->addLayout(write);
    column->addWidget(m_message);
    column->addWidget(m_text, 100);
    column->addStretch(1);  // takes the room while there is no result
    column->addLayout(bottom);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("toolsArea", page, this));

    connect(m_browse, &QPushButton::clicked, this, &ToolsPage::browse);
    connect(m_monitor, &QPushButton::clicked, this, &ToolsPage::monitorRequested);
    connect(m_open, &QPushButton::clicked, this, &ToolsPage::openMade);
    connect(m_back, &QPushButton::clicked, this, &ToolsPage::goBack);
    connect(m_into, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
}

void ToolsPage::present(const std::filesystem::path& study)
{
    m_study = std::filesystem::absolute(study).lexically_normal();
    if (!m_study.has_filename()) m_study = m_study.parent_path();
    m_made.clear();
    m_into->setText(QString::fromStdString(m_study.parent_path().string()));
    m_text->clear();
    m_text->hide();
    m_message->clearMessage();
    enable();
}

void ToolsPage::use(StudyTool tool)
{
    if (isBusy()) return;
    const std::filesystem::path into = m_into->text().trimmed().toStdString();
    m_made.clear();
    m_text->clear();
    m_text->hide();
    m_work.run(
        [this, tool, into, study = m_study, work = m_use](const std::atomic<bool>& isStopping) -> InBackground::Then {
            const auto progress = [&](double fraction, const std::string& what) {
                if (isStopping) throw std::runtime_error(tr("Stopped. Nothing was written.").toStdString());
                const QString text = tr("%1: %2 %").arg(inOwnLanguage(what)).arg(static_cast<int>(100 * fraction));
                QMetaObject::invokeMethod(
                    this, [this, text] { showProgress(text); }, Qt::QueuedConnection);
            };
            return [this, outcome = work(tool, study, into, progress)] { show(outcome); };
        },
        [this](const QString& why) {
            m_message->showFault(why);
            enable();
        });
    m_message->showDone(tr("Working… Esc stops long work."));
    enable();
}

void ToolsPage::showProgress(const QString& text)
{
    if (isBusy()) m_message->showDone(text);
}

void ToolsPage::show(const ToolOutcome& outcome)
{
    m_made = outcome.made;
    m_text->setPlainText(inOwnLanguage(outcome.text));
    m_text->show();
    if (!outcome.isSound)
        m_message->showFault(tr("The study has faults. Keep it as it is, make a backup, and show the list to its owner."));
    else if (!m_made.empty())
        m_message->showDone(tr("Written: %1").arg(QString::fromStdString(m_made.string())));
    else
        m_message->showDone(tr("Done. Nothing was written."));
    enable();
}

void ToolsPage::showFault(const QString& text) { m_message->showFault(text); }

void ToolsPage::enable()
{
    for (const Entry& entry : m_tools) entry.button->setEnabled(m_use && !isBusy());
    for (QWidget* control : {static_cast<QWidget*>(m_into), static_cast<QWidget*>(m_browse), static_cast<QWidget*>(m_monitor)})
        control->setEnabled(!isBusy());
    m_open->setEnabled(!isBusy() && !m_made.empty());
    setButtonText(*m_back, isBusy() ? tr("Stop (Esc)") : tr("Back (Esc)"));
    if (!focusWidget() || !focusWidget()->isEnabled()) focusFirst();
}

void ToolsPage::focusFirst() { (isBusy() ? m_back : m_tools.front().button)->setFocus(); }

void ToolsPage::goBack()
{
    if (!isBusy()) {
        Q_EMIT backRequested();
        return;
    }
    m_work.askToStop();
    m_message->showHint(tr("Stopping after this step…"));
}

void ToolsPage::browse()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder for new files"), m_into->text());
    if (!chosen.isEmpty()) m_into->setText(chosen);
}

void ToolsPage::openMade()
{
    if (!QDesktopServices::openUrl(QUrl::fromLocalFile(QString::fromStdString(m_made.string()))))
        m_message->showHint(tr("No program opens this here. Open it yourself: %1").arg(QString::fromStdString(m_made.string())));
}

void ToolsPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape) return goBack();
    if ((event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) && pressed) return pressed->click();
    if (event->modifiers() == Qt::NoModifier && !event->isAutoRepeat()) {
        for (const Entry& entry : m_tools)
            if (event->key() == entry.key) return entry.button->click();
        if (event->key() == Qt::Key_M) return m_monitor->click();
        if (event->key() == Qt::Key_O) return m_open->click();
    }
    QWidget::keyPressEvent(event);
}

}  // namespace study::app
