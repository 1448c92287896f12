#include "study/app/pages/checklist_page.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QRegularExpression>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "protocols/files/typed_number.h"
#include "study/app/pieces/line_form.h"
#include "study/app/pieces/pattern_buttons.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/tick_box.h"

namespace study::app {

namespace {

/// Whether the caption names a unit, such as "temperature in °C", so that a number is expected.
bool hasUnit(const QString& caption)
{
    static const QRegularExpression unit(QStringLiteral("[%°℃％]"));
    return caption.contains(unit);
}

/// "21.5", "21,5", "41 %".
bool isNumber(const QString& text)
{
    static const QRegularExpression number(QStringLiteral("^[+-]?\\d+([.,]\\d+)?\\s*([%％℃]|°C)?$"));
    return number.match(QString::fromStdString(protocols::typedNumber(text.toStdString()))).hasMatch();
}

}  // namespace

ChecklistPage::ChecklistPage(QWidget* parent)
    : StagePage(parent),
      m_rows(new QVBoxLayout),
      m_readings(new LineForm("reading", this)),
      m_patternsCaption(label("patternsCaption", Type::Body, this)),
      m_patterns(new PatternButtons(this)),
      m_action(mainButton("confirmButton", tr("Everything is ready (Enter)"), this))
{
    auto* head = new PageHead(this);
    head->setTexts(tr("Before the first presentation"),
                   tr("Work through the list. Press Space to tick a line. The program stores the time when you finish."));
    m_rows->setSpacing(4);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(14);
    column->addWidget(head);
    column->addLayout(m_rows);
    column->addLayout(m_messagePlace);
    column->addWidget(m_patternsCaption);
    column->addWidget(m_patterns);
    column->addWidget(m_readings);
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, &ChecklistPage::confirm);
    connect(m_readings, &LineForm::changed, this, [this] {
        m_isAskedAgain = false;
        Q_EMIT mended();
    });
    connect(m_patterns, &PatternButtons::patternRequested, this, &ChecklistPage::patternRequested);
}

void ChecklistPage::setPattern(const std::optional<TestPattern>& pattern) { m_patterns->setShown(pattern); }

void ChecklistPage::begin(const SessionFacts& facts)
{
    clearLayout(*m_rows);
    m_boxes.clear();
    for (const QString& line : facts.checklist) m_rows->addWidget(rowFor(line));
    const bool isThere = !facts.displayName.isEmpty();
    const bool playsPatterns = isThere && !facts.displayTakesTickets;
    showText(*m_patternsCaption,
             !isThere           ? QString()
             : !playsPatterns   ? tr("This display takes its images from the server only, so it plays no test patterns.")
             : facts.mmPerPixel ? tr("Feel the test pattern:")
                                : tr("Feel the test pattern. Gratings need the width of a pixel from the display page."));
    m_patterns->setVisible(playsPatterns);
    m_patterns->setUsable(playsPatterns, facts.mmPerPixel);
    m_patterns->setShown(std::nullopt);
    m_readings->setCaptions(facts.readings);
    m_isAskedAgain = false;
    m_readings->setVisible(!facts.readings.isEmpty());
    setTabOrderAfter(facts.readings.isEmpty() ? static_cast<QWidget&>(*this) : *m_readings, {m_action});
}

QWidget* ChecklistPage::rowFor(const QString& line)
{
    auto* row = new QWidget(this);
    auto* box = new TickBox(row);
    name(*box, qPrintable(QStringLiteral("check%1").arg(m_boxes.size() + 1)), line);
    auto* text = label("checkText", Type::Body, row);
    text->setText(line);
    text->setBuddy(box);
    for (QWidget* part : {static_cast<QWidget*>(box), static_cast<QWidget*>(text)}) part->installEventFilter(this);
    // Moves the focus to the next open line, so that pressing Space repeatedly ticks the whole list.
    connect(box, &QCheckBox::toggled, this, [this] { firstFocus().setFocus(); });
    connect(box, &QCheckBox::toggled, this, &StagePage::mended);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(box, 0, Qt::AlignTop);
    layout->addWidget(text, 1);
    m_boxes.push_back(box);
    return row;
}

QCheckBox* ChecklistPage::firstUnticked() const
{
    const auto found = std::find_if(m_boxes.begin(), m_boxes.end(), [](const QCheckBox* box) { return !box->isChecked(); });
    return found == m_boxes.end() ? nullptr : *found;
}

QString ChecklistPage::doubtAboutReadings() const
{
    for (const auto& [caption, text] : m_readings->lines()) {
        if (text.isEmpty()) return tr("Nothing is written for “%1”. Press Enter again to go on without it.").arg(caption);
        if (hasUnit(caption) && !isNumber(text))
            return tr("“%1” is not a number. Press Enter again to store it.").arg(shortName(text));
    }
    return {};
}

void ChecklistPage::confirm()
{
    if (QCheckBox* open = firstUnticked()) {
        open->setFocus();
        Q_EMIT hinted(tr("This line is not ticked yet: %1. Check it, then press Space.").arg(open->accessibleName()));
        return;
    }
    if (const QString doubt = doubtAboutReadings(); !doubt.isEmpty() && !std::exchange(m_isAskedAgain, true)) {
        Q_EMIT hinted(doubt);
        return;
    }
    session::ChecklistDone done{{}, m_readings->given()};
    for (const QCheckBox* box : m_boxes) done.ticked.push_back(box->accessibleName().toStdString());
    Q_EMIT eventRequested(done);
}

bool ChecklistPage::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::KeyPress && pressKey(static_cast<QKeyEvent*>(event)->key())) return true;
    if (const auto* text = qobject_cast<QLabel*>(watched); text && event->type() == QEvent::MouseButtonRelease)
        static_cast<QCheckBox*>(text->buddy())->toggle();
    return StagePage::eventFilter(watched, event);
}

bool ChecklistPage::pressKey(int key)
{
    if (!isEnter(key)) return false;
    if (m_isAskedAgain || !m_readings->focusNext()) confirm();
    return true;
}

QWidget& ChecklistPage::firstFocus()
{
    if (QCheckBox* open = firstUnticked()) return *open;
    if (QWidget* reading = m_readings->firstOpen()) return *reading;
    return *m_action;
}

QWidget* ChecklistPage::pinned() { return m_action; }

}  // namespace study::app
