#include "tests/support/open_window.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QRegularExpression>
#include <QTest>

#include "protocols/files/errors.h"
#include "tests/support/played_session.h"

namespace tests::support {

using namespace study::session;

namespace {

class RecordingDisplay final : public rendering::HapticDisplay {
public:
    explicit RecordingDisplay(std::shared_ptr<DisplayRecord> record) : m_record(std::move(record)) {}
    void show(const cv::Mat&) override
    {
        if (!m_record->fault.empty())
            throw protocols::workFailed({.what = m_record->fault, .where = "display", .expected = {}, .nextStep = "plug it in"});
        m_record->calls.push_back("show");
    }
    void clear() override { m_record->calls.push_back("clear"); }
    std::string name() const override { return "recording"; }
    bool reportsTouches() const override { return m_record->reportsTouches; }
    void onTouched(std::function<void(const rendering::Touch&)> touched) override
    {
        m_record->touch = [touched = std::move(touched)] { touched({}); };
    }

private:
    std::shared_ptr<DisplayRecord> m_record;
};

void addItemTexts(std::vector<QString>& texts, const QAbstractItemView& view)
{
    const QAbstractItemModel* model = view.model();
    for (int row = 0; model && row < model->rowCount(); ++row)
        for (int column = 0; column < model->columnCount(); ++column)
            for (const int role : {Qt::DisplayRole, Qt::ToolTipRole, Qt::AccessibleTextRole})
                texts.push_back(model->index(row, column).data(role).toString());
}

void addTexts(std::vector<QString>& texts, const QWidget& widget)
{
    for (const QString& text : {widget.windowTitle(), widget.toolTip(), widget.statusTip(), widget.whatsThis(),
                                widget.accessibleName(), widget.accessibleDescription(), widget.objectName()})
        texts.push_back(text);
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) texts.push_back(label->text());
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget))
        texts.push_back(QString(button->text()).replace(QLatin1String("&&"), QLatin1String("&")));
    if (const auto* line = qobject_cast<const QLineEdit*>(&widget)) {
        texts.push_back(line->text());
        texts.push_back(line->placeholderText());
    }
    if (const auto* words = qobject_cast<const QPlainTextEdit*>(&widget)) {
        texts.push_back(words->toPlainText());
        texts.push_back(words->placeholderText());
    }
    for (const QAction* action : widget.actions())
        for (const QString& text : {action->text(), action->toolTip(), action->statusTip(), action->whatsThis()})
            texts.push_back(text);
    if (const auto* box = qobject_cast<const QComboBox*>(&widget))
        for (int item = 0; item < box->count(); ++item) texts.push_back(box->itemText(item));
    if (const auto* bar = qobject_cast<const QProgressBar*>(&widget)) texts.push_back(bar->format());
    if (const auto* view = qobject_cast<const QAbstractItemView*>(&widget)) addItemTexts(texts, *view);
}

study::app::AppOptions withFakes(study::app::AppOptions options, const std::shared_ptr<DisplayRecord>& display,
                                 const std::shared_ptr<VirtualClock>& clock)
{
    if (!options.clock) options.clock = clock;
    options.openDisplay = [display](const std::string&, const std::stop_token&) {
        return std::make_unique<RecordingDisplay>(display);
    };
    return options;
}

}  // namespace

database::StudyFolder WindowTest::newStudy(const StudyRecipe& recipe)
{
    return buildStudy(m_folder.path().toStdString() + "/study" + std::to_string(++m_made), recipe);
}

ShownWindow::ShownWindow(const study::app::AppOptions& options) : window(options), gui(window) { window.show(); }

OpenWindow::OpenWindow(const database::StudyFolder& study, const study::app::AppOptions& options)
    : OpenWindow(study, options, DisplayRecord{})
{
}

OpenWindow::OpenWindow(const database::StudyFolder& study, const study::app::AppOptions& options, const DisplayRecord& display)
    : m_display(std::make_shared<DisplayRecord>(display)),
      m_clock(std::make_shared<VirtualClock>()),
      m_window(std::make_unique<study::app::MainWindow>(withFakes(options, m_display, m_clock))),
      m_gui(*m_window)
{
    m_window->show();
    m_window->openStudy(study.folder);
}

void OpenWindow::perform(const EventBody& event)
{
    m_clock->advanceSeconds(1.5);
    if (const auto refusal = m_gui.perform(event)) throw std::logic_error("refused: " + refusal->reason);
}

void OpenWindow::enrolAndBegin(const std::string& participant)
{
    m_window->startSession(protocols::ParticipantId(participant));
    playTo("PlacingTray");
}

EventBody OpenWindow::nextEvent()
{
    const auto* presenting = std::get_if<Presenting>(&view().state.stage);
    if (presenting && !presenting->touchedAtNs) return Touched{};
    const auto event = tests::support::nextEvent(view(), m_gui.plan());
    if (!event) throw std::logic_error("the session is over");
    return *event;
}

void OpenWindow::playTo(const std::string& stage, const std::string& question)
{
    const auto isThere = [&] {
        return nameOf(view().state) == stage && (question.empty() || (view().question && view().question->id.value == question));
    };
    while (!isThere()) perform(nextEvent());
}

void OpenWindow::playToEnd()
{
    while (!std::holds_alternative<Finished>(view().state.stage)) perform(nextEvent());
}

QString OpenWindow::message(const char* objectName)
{
    const auto* bar = m_window->currentPage()->findChild<QLabel*>(QString::fromLatin1(objectName));
    return bar && bar->isVisible() ? bar->text() : QString();
}

std::vector<QString> textsIn(const QWidget& root)
{
    std::vector<QString> texts;
    addTexts(texts, root);
    const auto children = root.findChildren<QWidget*>();
    for (const QWidget* widget : children) addTexts(texts, *widget);
    return texts;
}

std::vector<QString> textsNaming(const std::set<QString>& words, const std::vector<QString>& texts)
{
    static const QRegularExpression between(QStringLiteral("[^A-Za-z0-9_&+]+"));
    std::vector<QString> named;
    for (const QString& text : texts) {
        const QStringList tokens = text.split(between, Qt::SkipEmptyParts);
        for (const QString& token : tokens)
            if (words.contains(token) || words.contains(QString(token).remove(QLatin1Char('&')))) named.push_back(text);
    }
    return named;
}

}  // namespace tests::support
