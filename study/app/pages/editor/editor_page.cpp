#include "study/app/pages/editor/editor_page.h"

#include <QComboBox>
#include <QFileDialog>
#include <QKeyEvent>
#include <QScrollArea>
#include <QShortcut>
#include <QStackedWidget>
#include <QTimer>
#include <QVBoxLayout>

#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/app/drafts/draft_edits.h"
#include "study/app/language/app_text.h"
#include "study/app/language/below.h"
#include "study/app/pages/editor/analysis_section.h"
#include "study/app/pages/editor/check_panel.h"
#include "study/app/pages/editor/conditions_section.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pages/editor/editor_start.h"
#include "study/app/pages/editor/keyed_texts.h"
#include "study/app/pages/editor/page_preview.h"
#include "study/app/pages/editor/phases_section.h"
#include "study/app/pages/editor/plain_sections.h"
#include "study/app/pages/editor/section_tabs.h"
#include "study/app/pages/editor/study_section.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

namespace fs = std::filesystem;

QString shownPath(const fs::path& path) { return QString::fromStdString(path.string()); }

constexpr int checkAfterMs = 120;

}  // namespace

EditorPage::EditorPage(LookAtData look, LookAhead lookAhead, QWidget* parent)
    : QWidget(parent),
      m_look(std::move(look)),
      m_lookAhead(std::move(lookAhead)),
      m_fields(new DraftFields(this)),
      m_pages(new QStackedWidget(this)),
      m_start(new EditorStart(this)),
      m_editor(new QWidget(this)),
      m_checkTimer(new QTimer(this))
{
    setObjectName("editorPage");
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(m_pages);
    m_pages->addWidget(m_start);
    m_pages->addWidget(m_editor);
    buildEditor();
    connectParts();
}

EditorPage::~EditorPage()
{
    delete m_pages;  // before the fields, which its controls use until they are gone
}

void EditorPage::buildEditor()
{
    auto* column = new QVBoxLayout(m_editor);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* top = new QWidget(m_editor);
    auto* head = new QVBoxLayout(top);
    head->setContentsMargins(28, 12, 28, 6);
    head->setSpacing(8);
    m_title = label("editorTitle", Type::Lead, top, Weight::Bold);
    head->addWidget(m_title);
    m_tabs = new SectionTabs(top);
    head->addWidget(m_tabs);
    column->addWidget(top);

    m_sections = new QStackedWidget(m_editor);
    m_study = new StudySection(*m_fields, m_look, this);
    m_conditions = new ConditionsSection(*m_fields, this);
    m_phases = new PhasesSection(*m_fields, this);
    m_analysis = new AnalysisSection(*m_fields, this);
    for (QWidget* section : std::initializer_list<QWidget*>{m_study, m_conditions, m_phases, courseSection(*m_fields, this),
                                                            textsSection(*m_fields, this), m_analysis}) {
        section->setProperty("scrollsAlways", true);  // page_fit.h
        m_sections->addWidget(
            scrolling(qPrintable(QStringLiteral("section%1Area").arg(m_sections->count() + 1)), section, m_sections));
    }
    m_keyedTexts = m_sections->findChildren<KeyedTexts*>();
    m_panel = new CheckPanel(*m_fields, m_lookAhead, this);
    m_panel->setProperty("scrollsAlways", true);
    m_panelArea = scrolling("checkArea", m_panel, m_editor);
    auto* body = new QHBoxLayout;
    body->setSpacing(0);
    body->addWidget(m_sections, 3);
    body->addWidget(m_panelArea, 2);
    column->addLayout(body, 1);
    buildBars(*m_editor);
    column->addWidget(m_guard);
    column->addWidget(m_bar);
}

void EditorPage::buildBars(QWidget& editor)
{
    m_guard = new LeaveGuard(&editor);
    m_bar = new QFrame(&editor);
    m_bar->setObjectName("editorBar");
    setRole(*m_bar, "bar");
    auto* column = new QVBoxLayout(m_bar);
    column->setContentsMargins(28, 8, 28, 8);
    m_message = new MessageBar("editorMessage", m_bar);
    m_summary = plainButton("panelButton", QString(), m_bar);
    m_save = mainButton("saveButton", tr("Save (Ctrl S)"), m_bar);
    setType(*m_save, Type::Body, Weight::Bold);
    m_saveAs = button("saveAsButton", tr("Save as…"), m_bar);
    m_make = button("makeStudyButton", tr("Make the study…"), m_bar);
    m_undo = button("undoButton", tr("Undo (Ctrl Z)"), m_bar);
    m_back = button("editorBackButton", tr("Back (Esc)"), m_bar);
    column->addWidget(m_message);
    column->addWidget(m_summary, 0, Qt::AlignLeft);
    column->addLayout(actionsRow({m_save, m_make, m_saveAs, m_undo, m_back}));
}

void EditorPage::connectParts()
{
    connect(m_start, &EditorStart::exampleChosen, this, [this](const QString& text) {
        ProtocolDraft begun = text.isEmpty() ? ProtocolDraft() : ProtocolDraft::fromText(text.toStdString(), "the example");
        begun.erase("$schema");  // its path is that of the example
        takeLanguage(begun, languageOfWindow().toStdString());
        edit(begun, {});
    });
    connect(m_start, &EditorStart::fileChosen, this, [this](const QString& file) { open(file.toStdString()); });
    connect(m_start, &EditorStart::backRequested, this, &EditorPage::backRequested);
    connect(m_tabs, &SectionTabs::chosen, this, &EditorPage::showSection);
    connect(m_guard, &LeaveGuard::stayRequested, this, &EditorPage::stay);
    connect(m_guard, &LeaveGuard::saveRequested, this, [this] {
        m_guard->hide();
        if (save()) leave();
    });
    connect(m_guard, &LeaveGuard::dropRequested, this, [this] {
        m_begun = draft();
        m_saved.reset();
        leave();
    });
    connect(m_fields, &DraftFields::edited, this, &EditorPage::checkSoon);
    connect(m_fields, &DraftFields::visited, this, [this](const QString& place) {
        if (const auto question = numberIn(place.toStdString(), "questions[")) m_panel->preview().showQuestion(*question);
    });
    for (KeyedTexts* texts : m_keyedTexts)
        connect(texts, &KeyedTexts::chosen, this, [this](const QString& key) { m_panel->preview().showText(key); });
    connect(m_phases, &PhasesSection::chosenChanged, this, &EditorPage::checkSoon);
    connect(m_panel, &CheckPanel::jumpRequested, this, &EditorPage::jumpTo);
    // Queued, because the step destroys the button that asks for it.
    connect(m_panel, &CheckPanel::removeRequested, this, &EditorPage::removeKey, Qt::QueuedConnection);
    connect(m_summary, &QPushButton::clicked, this, [this] { showPanel(!m_isPanelShown); });
    connect(m_save, &QPushButton::clicked, this, &EditorPage::save);
    connect(m_saveAs, &QPushButton::clicked, this, &EditorPage::saveAs);
    connect(m_make, &QPushButton::clicked, this, &EditorPage::makeStudy);
    connect(m_undo, &QPushButton::clicked, m_fields, &DraftFields::undo);
    connect(m_back, &QPushButton::clicked, this, &EditorPage::leave);
    m_checkTimer->setSingleShot(true);
    m_checkTimer->setInterval(checkAfterMs);
    connect(m_checkTimer, &QTimer::timeout, this, &EditorPage::check);
    const auto onKey = [this](const QKeySequence& keys, auto work) {
        auto* shortcut = new QShortcut(keys, m_editor);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, this, work);
    };
    onKey(QKeySequence::Save, [this] { save(); });
    onKey(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S), [this] { saveAs(); });
    onKey(QKeySequence::Undo, [this] { m_fields->undo(); });
    onKey(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z), [this] { m_fields->redo(); });
    onKey(QKeySequence(Qt::Key_F6), [this] { showPanel(!m_isPanelShown); });
    for (int number = 0; number < editorSections; ++number)
        onKey(QKeySequence(Qt::ALT | static_cast<Qt::Key>(Qt::Key_1 + number)),
              [this, number] { showSection(static_cast<EditorSection>(number)); });
}

// ---- drafts and files

const ProtocolDraft& EditorPage::draft() const { return m_fields->draft(); }

bool EditorPage::hasUnsavedChanges() const
{
    return m_pages->currentWidget() == m_editor && draft() != (m_saved ? *m_saved : m_begun);
}

bool EditorPage::isBusy() const { return m_checkTimer->isActive() || m_panel->isComputing() || m_study->isReading(); }

void EditorPage::offerExamples()
{
    m_pages->setCurrentWidget(m_start);
    m_start->focusFirst();
}

void EditorPage::offerFile()
{
    m_pages->setCurrentWidget(m_start);
    m_start->focusFile();
}

void EditorPage::open(const fs::path& file)
{
    try {
        const std::string text = protocols::readProtocolText(file);
        const ProtocolDraft opened = ProtocolDraft::fromText(text, file.string());
        const bool isOfStudy = belongsToStudy(file);
        edit(opened, isOfStudy ? fs::path() : file);
        if (!isOfStudy) m_savedText = text;
        check();
        if (isOfStudy)
            m_message->showHint(
                tr("This protocol belongs to a study that exists; `vis2hap study amend` changes it there. Here you "
                   "edit a copy for a new study."));
        else if (!m_panel->faults().empty())
            m_message->showHint(tr("The file has faults: %1. Each is shown with line and column.").arg(m_panel->faults().size()));
    } catch (const std::exception& fault) {
        offerFile();
        m_start->showFault(inOwnLanguage(fault.what()));
    }
}

void EditorPage::edit(const ProtocolDraft& draft, const fs::path& file)
{
    m_file = file;
    m_begun = draft;
    m_saved = file.empty() ? std::nullopt : std::optional(draft);
    m_savedText.clear();
    m_conditions->setFolder(file.empty() ? QString() : shownPath(fs::absolute(file).parent_path()));
    m_message->clearMessage();
    m_guard->hide();
    m_isPanelShown = false;
    m_panel->clear();
    m_fields->begin(draft);
    m_phases->choose(0);
    m_pages->setCurrentWidget(m_editor);
    showSection(EditorSection::Study);
    arrange();
    check();
}

void EditorPage::commitField()
{
    // The name of a question is taken when its field is left.
    if (auto* line = qobject_cast<QLineEdit*>(focusWidget())) Q_EMIT line->editingFinished();
}

bool EditorPage::save()
{
    commitField();
    return m_file.empty() ? saveAs() : write(m_file);
}

bool EditorPage::saveAs()
{
    commitField();
    const QString proposed = m_file.empty() ? QStringLiteral("protocol.json") : shownPath(m_file);
    QString chosen = QFileDialog::getSaveFileName(this, tr("Save the protocol"), proposed, tr("Protocols (*.json)"));
    if (chosen.isEmpty()) return false;
    if (!chosen.contains(QLatin1Char('.'))) chosen += QStringLiteral(".json");
    return write(chosen.toStdString());
}

bool EditorPage::write(const fs::path& file)
{
    if (belongsToStudy(file)) {
        m_message->showFault(
            tr("This folder belongs to a study that exists. Save the protocol elsewhere; `vis2hap study amend` "
               "changes the protocol of that study."));
        return false;
    }
    const fs::path before = fs::absolute(m_file.empty() ? file : m_file).parent_path(), now = fs::absolute(file).parent_path();
    try {
        ProtocolDraft written = draft();
        if (before != now) makeImageFoldersAbsolute(written, before);
        const bool isAsItStands = m_saved && written == *m_saved && !m_savedText.empty();
        const std::string text = isAsItStands ? m_savedText : written.fileText();
        protocols::writeWholeFile(file, text);
        m_savedText = text;
        if (written != draft()) m_fields->change([&](ProtocolDraft& draft) { draft = written; });
        m_saved = written;
    } catch (const std::exception& fault) {
        m_message->showFault(inOwnLanguage(fault.what()));
        return false;
    }
    m_file = file;
    m_conditions->setFolder(shownPath(now));
    check();
    QString said = tr("Saved: %1").arg(shownPath(file));
    if (const auto beside = filesBeside(draft()); before != now && !beside.empty())
        said += QLatin1Char('\n') +
                tr("Copy its recordings there, too: %1")
                    .arg(QString::fromStdString(beside.front()) + (beside.size() > 1 ? QStringLiteral(", …") : QString()));
    m_message->showDone(said);
    return true;
}

void EditorPage::makeStudy()
{
    commitField();
    check();
    if (!m_panel->faults().empty()) {
        m_message->showHint(
            tr("A study cannot follow this protocol yet. Mend the faults first: %1").arg(m_panel->faults().size()));
        showPanel(true);
        return;
    }
    if ((m_file.empty() || hasUnsavedChanges()) && !save()) return;
    Q_EMIT studyRequested(shownPath(m_file));
}

bool EditorPage::mayClose()
{
    if (!hasUnsavedChanges()) return true;
    m_guard->ask();
    return false;
}

void EditorPage::leave()
{
    commitField();
    if (!mayClose()) return;
    m_guard->hide();
    offerExamples();
    Q_EMIT backRequested();
}

void EditorPage::stay()
{
    m_guard->hide();
    m_back->setFocus();
}

// ---- sections, faults and looks

void EditorPage::showSection(EditorSection section)
{
    const int place = static_cast<int>(section);
    m_isPanelShown = false;
    arrange();
    m_sections->setCurrentIndex(place);
    m_tabs->setChosen(section);
    QWidget* first = m_sections->currentWidget();
    for (QWidget* next = first->nextInFocusChain(); next && next != first; next = next->nextInFocusChain())
        if (m_sections->currentWidget()->isAncestorOf(next) && (next->focusPolicy() & Qt::TabFocus) && next->isVisibleTo(this) &&
            next->isEnabled()) {
            next->setFocus();
            return;
        }
}

void EditorPage::jumpTo(const QString& place)
{
    const std::string path = place.toStdString();
    showSection(sectionOf(path));
    if (const auto phase = numberIn(path, "phases[")) {
        if (*phase != m_phases->chosen() && *phase < static_cast<int>(draft().countAt("phases"))) m_phases->choose(*phase);
    }
    if (const auto contrast = numberIn(path, "planned[")) m_analysis->choose(*contrast);
    for (KeyedTexts* texts : m_keyedTexts)
        if (path.starts_with(texts->object() + ".")) texts->choose(path.substr(texts->object().size() + 1));
    const DraftFields::Bound* bound = m_fields->boundAt(path);
    if (!bound) {
        m_message->showHint(tr("This page does not show that field. It is kept as it is in the file."));
        return;
    }
    bound->control->setFocus(Qt::OtherFocusReason);
    if (auto* line = qobject_cast<QLineEdit*>(bound->control)) line->selectAll();
}

void EditorPage::removeKey(const QString& object, const QString& key)
{
    ProtocolDraft changed = draft();
    if (!changed.eraseKey(object.toStdString(), key.toStdString())) {
        m_message->showHint(tr("This page cannot remove that key. Nothing was changed. Remove it in a text editor."));
        return;
    }
    m_fields->change([&](ProtocolDraft& draft) { draft = changed; });
}

void EditorPage::checkSoon()
{
    showTitle();
    m_message->clearMessage();
    m_undo->setEnabled(m_fields->history().canUndo());
    m_checkTimer->start();
}

void EditorPage::check()
{
    m_checkTimer->stop();
    const bool isAsItStands = m_saved && draft() == *m_saved && !m_savedText.empty();
    const protocols::CheckedProtocol checked =
        protocols::checkedProtocol(isAsItStands ? m_savedText : draft().fileText(), "the protocol");
    m_panel->present(checked, m_phases->chosen(), isAsItStands);
    showTitle();
    arrange();
}

void EditorPage::showTitle()
{
    const QString name = m_file.empty() ? tr("New protocol") : shownPath(m_file.filename());
    m_title->setText(hasUnsavedChanges() ? tr("%1 (not saved)").arg(name) : name);
}

void EditorPage::arrange()
{
    constexpr int widestForOne = 140;  // characters
    const bool hasRoom = width() >= widestForOne * fontMetrics().averageCharWidth();
    const bool isLow = isLowFor(*this) || !hasRoom;
    m_sections->setVisible(hasRoom || !m_isPanelShown);
    m_panelArea->setVisible(hasRoom || m_isPanelShown);
    m_summary->setVisible(!hasRoom);
    setButtonText(*m_summary, m_isPanelShown ? tr("Back to the fields (F6)") : tr("%1. Details (F6)").arg(m_panel->summary()));
    m_tabs->setNarrow(isLow);
    m_title->setVisible(!isLowFor(*this));
    m_undo->setVisible(!isLow);
    m_saveAs->setVisible(!isLow);
}

void EditorPage::showPanel(bool isShown)
{
    m_isPanelShown = isShown;
    arrange();
    if (isShown && m_panelArea->isVisible()) m_panel->preview().choice().setFocus();
    if (auto* go = m_panel->findChild<QPushButton*>("goToFault1"); isShown && go) go->setFocus();
}

void EditorPage::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    arrange();
}

void EditorPage::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        QMetaObject::invokeMethod(this, &EditorPage::arrange, Qt::QueuedConnection);
}

void EditorPage::focusFirst()
{
    if (m_pages->currentWidget() == m_start)
        m_start->focusFirst();
    else
        showSection(EditorSection::Study);
}

void EditorPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    const bool isStart = m_pages->currentWidget() == m_start;
    if (event->key() == Qt::Key_Escape && isStart)
        Q_EMIT backRequested();
    else if (event->key() == Qt::Key_Escape && m_guard->isVisible())
        stay();
    else if (event->key() == Qt::Key_Escape)
        leave();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()) && isStart)
        m_start->accept();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
