#include "study/app/pages/editor/draft_fields.h"

#include <QComboBox>
#include <QKeyEvent>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QVBoxLayout>
#include <algorithm>

#include "study/app/language/app_text.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/tick_box.h"

namespace study::app {

namespace {

/// "phases[0]" is around "phases[0].scale", and at itself.
bool isAtOrAround(const std::string& outer, const std::string& inner)
{
    return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
}

/// Fits the height of a list to its rows when rows or text sizes change.
class RowsFit : public QObject {
public:
    RowsFit(QListWidget& list, int mostRows) : QObject(&list), m_list(list), m_mostRows(mostRows)
    {
        list.installEventFilter(this);
        connect(list.model(), &QAbstractItemModel::rowsInserted, this, &RowsFit::fit);
        connect(list.model(), &QAbstractItemModel::rowsRemoved, this, &RowsFit::fit);
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange || event->type() == QEvent::Show)
            QMetaObject::invokeMethod(this, &RowsFit::fit, Qt::QueuedConnection);
        return QObject::eventFilter(watched, event);
    }

private:
    void fit()
    {
        const int rows = std::clamp(m_list.count(), 1, m_mostRows);
        const int height = rows * std::max(m_list.sizeHintForRow(0), m_list.fontMetrics().height()) + 16;
        if (m_list.height() != height || m_list.maximumHeight() != height) m_list.setFixedHeight(height);
    }

    QListWidget& m_list;
    int m_mostRows;
};

void collectControls(const QLayout& layout, std::vector<QWidget*>& controls)
{
    for (int place = 0; place < layout.count(); ++place) {
        QLayoutItem& item = *layout.itemAt(place);
        if (item.layout()) collectControls(*item.layout(), controls);
        QWidget* widget = item.widget();
        if (!widget) continue;
        if (widget->focusPolicy() & Qt::TabFocus)
            controls.push_back(widget);
        else if (widget->layout())
            collectControls(*widget->layout(), controls);
    }
}

}  // namespace

void DraftFields::begin(const ProtocolDraft& draft)
{
    m_history.begin(draft);
    showAll();
    Q_EMIT replaced();
    Q_EMIT edited();
}

void DraftFields::edit(const std::string& field, const std::function<void(ProtocolDraft&)>& work)
{
    if (m_isShowing) return;
    ProtocolDraft changed = draft();
    work(changed);
    if (changed == draft()) return;
    m_history.add(changed, field);
    Q_EMIT edited();
}

void DraftFields::change(const std::function<void(ProtocolDraft&)>& work)
{
    ProtocolDraft changed = draft();
    work(changed);
    m_history.add(changed, {});
    showAll();
    Q_EMIT replaced();
    Q_EMIT edited();
}

void DraftFields::undo()
{
    if (!m_history.canUndo()) return;
    m_history.undo();
    showAll();
    Q_EMIT replaced();
    Q_EMIT edited();
}

void DraftFields::redo()
{
    if (!m_history.canRedo()) return;
    m_history.redo();
    showAll();
    Q_EMIT replaced();
    Q_EMIT edited();
}

void DraftFields::showAll()
{
    m_isShowing = true;
    for (const Bound& bound : m_bound)
        if (bound.show) bound.show();
    m_isShowing = false;
}

void DraftFields::take(const std::string& place, FieldKind kind, const QString& typed)
{
    edit(place, [&](ProtocolDraft& draft) { draft.setTyped(place, kind, typed.toStdString()); });
}

void DraftFields::bind(const std::string& place, const QString& caption, QWidget& control)
{
    m_bound.push_back({place, caption, &control, {}});
    control.installEventFilter(this);
}

QLineEdit* DraftFields::boundLine(const std::string& place, const QString& caption, FieldKind kind, const QString& hint,
                                  QWidget* parent)
{
    QLineEdit* line = field(place.c_str(), caption, parent);
    line->setPlaceholderText(kind == FieldKind::Number ? withDecimalMark(hint) : hint);
    bind(place, caption, *line);
    m_bound.back().show = [this, place, kind, line] {
        const QString typed = QString::fromStdString(draft().typedAt(place));
        const QString text = kind == FieldKind::Number ? withDecimalMark(typed) : typed;
        if (line->text() != text) line->setText(text);
    };
    m_bound.back().show();
    connect(line, &QLineEdit::textEdited, this, [this, place, kind](const QString& text) { take(place, kind, text); });
    return line;
}

QLineEdit* DraftFields::addLine(QBoxLayout& column, const std::string& place, const QString& caption, FieldKind kind,
                                const QString& hint)
{
    QLineEdit* line = boundLine(place, caption, kind, hint, column.parentWidget());
    addCaptioned(column, caption, *line);
    return line;
}

QLineEdit* DraftFields::addShortLine(FlowLayout& row, const std::string& place, const QString& caption, FieldKind kind,
                                     const QString& hint)
{
    QLineEdit* line = boundLine(place, caption, kind, hint, row.parentWidget());
    row.addWidget(captioned(caption, *line, row.parentWidget()));
    return line;
}

QPlainTextEdit* DraftFields::addLines(QBoxLayout& column, const std::string& place, const QString& caption, FieldKind kind,
                                      const QString& hint)
{
    auto* words = new QPlainTextEdit(column.parentWidget());
    name(*words, place.c_str(), caption);
    setType(*words, Type::Body);
    words->setTabChangesFocus(true);
    words->setPlaceholderText(hint);
    bind(place, caption, *words);
    m_bound.back().show = [this, place, kind, words] {
        // A line that is still empty is none of the draft's, but must not vanish under the cursor.
        ProtocolDraft same = draft();
        same.setTyped(place, kind, words->toPlainText().toStdString());
        if (same == draft() && !words->toPlainText().isEmpty()) return;
        const QString text = QString::fromStdString(draft().typedAt(place));
        if (words->toPlainText() != text) words->setPlainText(text);
    };
    m_bound.back().show();
    fitLines(*words);
    connect(words, &QPlainTextEdit::textChanged, this, [this, place, kind, words] {
        fitLines(*words);
        take(place, kind, words->toPlainText());
    });
    addCaptioned(column, caption, *words);
    return words;
}

TickBox* DraftFields::addTick(QBoxLayout& column, const std::string& place, const QString& caption)
{
    auto* tick = new TickBox(column.parentWidget());
    name(*tick, place.c_str(), caption);
    bind(place, caption, *tick);
    m_bound.back().show = [this, place, tick] { tick->setChecked(draft().at(place) == true); };
    m_bound.back().show();
    connect(tick, &TickBox::toggled, this, [this, place](bool isOn) {
        edit({}, [&](ProtocolDraft& draft) {
            // An absent key means no.
            if (isOn || draft.has(place)) draft.set(place, isOn);
        });
    });
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    QLabel* text = label("tickCaption", Type::Body, column.parentWidget());
    text->setText(caption);
    tick->takeClicksOf(*text);
    row->addWidget(tick, 0, Qt::AlignTop);
    row->addWidget(text, 1);
    column.addLayout(row);
    return tick;
}

void DraftFields::forget(const QWidget& widget)
{
    std::erase_if(m_bound, [&](const Bound& bound) { return bound.control == &widget || widget.isAncestorOf(bound.control); });
}

const DraftFields::Bound* DraftFields::boundAt(const std::string& place) const
{
    const Bound* around = nullptr;
    for (const Bound& bound : m_bound)
        if (isAtOrAround(bound.place, place) && (!around || bound.place.size() > around->place.size())) around = &bound;
    if (around && around->place == place) return around;
    const auto inside = std::ranges::find_if(m_bound, [&](const Bound& bound) { return isAtOrAround(place, bound.place); });
    return inside != m_bound.end() ? &*inside : around;
}

bool DraftFields::eventFilter(QObject* watched, QEvent* event)
{
    // Text fields would undo only their own typing.
    if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
        auto* key = static_cast<QKeyEvent*>(event);
        const bool isUndo = key->matches(QKeySequence::Undo), isRedo = key->matches(QKeySequence::Redo);
        if (isUndo || isRedo) {
            event->accept();
            if (event->type() == QEvent::KeyPress) isUndo ? undo() : redo();
            return true;
        }
    }
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::Show)
        if (auto* words = qobject_cast<QPlainTextEdit*>(watched))
            QMetaObject::invokeMethod(
                words, [words] { fitLines(*words); }, Qt::QueuedConnection);
    if (event->type() == QEvent::FocusIn)
        for (const Bound& bound : m_bound)
            if (bound.control == watched) {
                m_history.endStep();
                Q_EMIT visited(QString::fromStdString(bound.place));
                break;
            }
    return QObject::eventFilter(watched, event);
}

QString withDecimalMark(QString text)
{
    static const QRegularExpression point(QStringLiteral("^(-?\\d+)\\.(\\d+)$"));
    return text.replace(point, "\\1" + decimalMark() + "\\2");
}

void addCaptioned(QBoxLayout& column, const QString& caption, QWidget& control)
{
    QLabel* text = quietLabel("fieldCaption", column.parentWidget(), Type::Plain);
    text->setText(caption);
    auto* both = new QVBoxLayout;
    both->setSpacing(4);
    both->addWidget(text);
    both->addWidget(&control);
    column.addLayout(both);
}

QWidget* captioned(const QString& caption, QWidget& control, QWidget* parent)
{
    auto* cell = new QWidget(parent);
    auto* column = new QVBoxLayout(cell);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    QLabel* text = quietLabel("fieldCaption", cell, Type::Plain);
    text->setWordWrap(false);
    text->setText(caption);
    column->addWidget(text);
    column->addWidget(&control);
    return cell;
}

QComboBox* choiceBox(const char* objectName, const QString& accessibleName, QWidget* parent)
{
    auto* box = new QComboBox(parent);
    name(*box, objectName, accessibleName);
    setType(*box, Type::Body);
    box->setFocusPolicy(Qt::StrongFocus);
    box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    box->setMinimumContentsLength(6);
    return box;
}

void fitLines(QPlainTextEdit& words)
{
    constexpr int fewestLines = 3, mostLines = 8;
    const int lines = std::clamp(words.blockCount() + 1, fewestLines, mostLines);
    const int height = lines * words.fontMetrics().lineSpacing() + 26;
    if (words.height() != height || words.maximumHeight() != height) words.setFixedHeight(height);
}

void fitRows(QListWidget& list, int mostRows) { new RowsFit(list, mostRows); }

void orderTabs(QWidget& widget)
{
    std::vector<QWidget*> controls;
    if (widget.layout()) collectControls(*widget.layout(), controls);
    for (std::size_t i = 1; i < controls.size(); ++i) QWidget::setTabOrder(controls[i - 1], controls[i]);
}

void addHead(QBoxLayout& column, const char* objectName, const QString& title, const QString& sentence)
{
    QLabel* head = label(objectName, Type::Lead, column.parentWidget(), Weight::Bold);
    head->setText(title);
    column.addWidget(head);
    QLabel* text =
        quietLabel(qPrintable(QLatin1String(objectName) + QLatin1String("Sentence")), column.parentWidget(), Type::Plain);
    text->setText(sentence);
    column.addWidget(text);
}

void addSmallHead(QBoxLayout& column, const char* objectName, const QString& title, const QString& sentence)
{
    column.addSpacing(10);
    QLabel* head = label(objectName, Type::Body, column.parentWidget(), Weight::Bold);
    head->setText(title);
    column.addWidget(head);
    if (sentence.isEmpty()) return;
    QLabel* text =
        quietLabel(qPrintable(QLatin1String(objectName) + QLatin1String("Sentence")), column.parentWidget(), Type::Plain);
    text->setText(sentence);
    column.addWidget(text);
}

}  // namespace study::app
