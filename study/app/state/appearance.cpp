#include "study/app/state/appearance.h"

#include <QApplication>
#include <QRegularExpression>
#include <QStyle>
#include <QStyleFactory>
#include <algorithm>
#include <cmath>

namespace study::app {

namespace {

constexpr int smallestPercent = 75;
constexpr int largestPercent = 250;
constexpr int percentStep = 25;
constexpr char enlargement[] = "textEnlargement";

struct TypeRow {
    Type type;
    const char* name;
    double factor;
};
constexpr TypeRow typeRows[] = {{Type::Small, "small", 1.0}, {Type::Plain, "plain", 1.15}, {Type::Body, "body", 1.35},
                                {Type::Lead, "lead", 1.6},   {Type::Words, "words", 2.0},  {Type::Title, "title", 2.3},
                                {Type::Huge, "huge", 5.2}};

const TypeRow& rowOf(Type type)
{
    return *std::find_if(std::begin(typeRows), std::end(typeRows), [type](const TypeRow& row) { return row.type == type; });
}

double luminanceOf(const QColor& colour)
{
    const auto linear = [](double channel) {
        return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

Appearance withPercent(Appearance appearance, int percent)
{
    appearance.textPercent = std::clamp(percent, smallestPercent, largestPercent);
    return appearance;
}

}  // namespace

Colours coloursOf(Theme theme)
{
    if (theme == Theme::HighContrast)
        return {.background = QColor("#000000"),
                .surface = QColor("#000000"),
                .text = QColor("#ffffff"),
                .quietText = QColor("#f0f0f0"),
                .line = QColor("#545454"),
                .offText = QColor("#b8b8b8"),
                .accent = QColor("#ffe14d"),
                .onAccent = QColor("#000000"),
                .attention = QColor("#ffffff"),
                .onAttention = QColor("#000000"),
                .fault = QColor("#ffb3ab"),
                .onFault = QColor("#000000")};
    if (theme == Theme::DarkRoom)
        return {.background = QColor("#15181d"),
                .surface = QColor("#1f242c"),
                .text = QColor("#e8eaee"),
                .quietText = QColor("#a9b1bd"),
                .line = QColor("#3d4653"),
                .offText = QColor("#6b7482"),
                .accent = QColor("#8fb8ee"),
                .onAccent = QColor("#10161f"),
                .attention = QColor("#4a3a12"),
                .onAttention = QColor("#ffe4a3"),
                .fault = QColor("#57211f"),
                .onFault = QColor("#ffd9d6")};
    return {.background = QColor("#f4f3ef"),
            .surface = QColor("#ffffff"),
            .text = QColor("#1d2430"),
            .quietText = QColor("#566070"),
            .line = QColor("#c9cdd4"),
            .offText = QColor("#8b94a1"),
            .accent = QColor("#1f5c99"),
            .onAccent = QColor("#ffffff"),
            .attention = QColor("#fff0c9"),
            .onAttention = QColor("#5a4200"),
            .fault = QColor("#fbdedb"),
            .onFault = QColor("#7a1b14")};
}

QPalette paletteOf(const Colours& c)
{
    QPalette palette;
    palette.setColor(QPalette::Window, c.background);
    palette.setColor(QPalette::WindowText, c.text);
    palette.setColor(QPalette::Base, c.surface);
    palette.setColor(QPalette::AlternateBase, c.background);
    palette.setColor(QPalette::Text, c.text);
    palette.setColor(QPalette::Button, c.surface);
    palette.setColor(QPalette::ButtonText, c.text);
    palette.setColor(QPalette::PlaceholderText, c.quietText);
    palette.setColor(QPalette::Highlight, c.accent);
    palette.setColor(QPalette::HighlightedText, c.onAccent);
    palette.setColor(QPalette::ToolTipBase, c.surface);
    palette.setColor(QPalette::ToolTipText, c.text);
    palette.setColor(QPalette::Mid, c.line);
    palette.setColor(QPalette::Link, c.accent);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        palette.setColor(QPalette::Disabled, role, c.quietText);
    return palette;
}

const char* nameOf(Type type) { return rowOf(type).name; }

double factorOf(Type type) { return rowOf(type).factor; }

QString styleSheetOf(const Colours& c, double basePoints, int pixels)
{
    // The property "role" of a widget (pieces.h) selects its style. %1, %2, … are the colours in the order of `inOrder`.
    const QString sheet = QStringLiteral(R"(
QLabel[role="quiet"] { color: %4; }
QFrame[role="card"] { background: %2; border: 1px solid %5; border-radius: 10px; }
QFrame[role="card-new"] { background: %2; border: 3px solid %6; border-radius: 10px; }
QLabel[role="tag"] { color: %4; }
QLabel[role="tag-new"] { background: %6; color: %7; border-radius: 6px; padding: 2px 10px; }
QLabel[role="hint"] { background: %8; color: %9; border-radius: 8px; padding: 10px 14px; }
QLabel[role="done"] { background: %2; color: %3; border-radius: 8px; padding: 10px 14px; }
QLabel[role="fault"] { background: %10; color: %11; border-radius: 8px; padding: 10px 14px; }
QFrame[role="bar"] { background: %2; border: none; }
QPushButton { background: %2; color: %3; border: 1px solid %4; border-radius: 8px; padding: 7px 16px; }
QPushButton:hover { border-color: %6; }
QPushButton:focus { border: 2px solid %6; padding: 6px 15px; }
QPushButton:disabled { color: %12; border-color: %5; background: %1; }
QPushButton[role="stamp"]:disabled { color: %4; }
QPushButton:checked { background: %6; color: %7; border-color: %6; }
QPushButton:checked:focus { border-color: %3; }
QPushButton:checked:disabled { background: %5; color: %3; border-color: %5; }
QPushButton[role="main"] { background: %6; color: %7; border: 2px solid %6; padding: 10px 26px; }
QPushButton[role="main"]:focus { border-color: %3; }
QPushButton[role="main"]:disabled { background: %5; color: %3; border-color: %5; }
QPushButton[role="answer"] { padding: 14px 22px; text-align: left; }
QPushButton[role="plain"] { background: transparent; border: 2px solid transparent; padding: 5px 10px; color: %4; }
QPushButton[role="plain"]:hover { color: %3; border-color: %5; }
QPushButton[role="plain"]:focus { border-color: %6; color: %3; }
QPushButton[role="plain"]:disabled { background: transparent; border-color: transparent; color: %12; }
QLineEdit, QPlainTextEdit, QComboBox { background: %2; color: %3; border: 1px solid %4; border-radius: 8px; padding: 7px 10px; }
QLineEdit:focus, QPlainTextEdit:focus, QComboBox:focus { border: 2px solid %6; padding: 6px 9px; }
QLineEdit:disabled, QPlainTextEdit:disabled, QComboBox:disabled { background: %1; color: %4; border-color: %5; }
QPlainTextEdit[role="table"] { font-family: "DejaVu Sans Mono", "Noto Sans Mono", monospace; }
QComboBox { combobox-popup: 0; }
QComboBox::drop-down { border: none; width: 34px; }
QComboBox::down-arrow { image: url(:/icons/choice.png); width: 14px; height: 14px; }
QTreeView, QListView { background: %2; color: %3; border: 1px solid %5; border-radius: 8px; padding: 4px; }
QTreeView:focus, QListView:focus { border: 2px solid %6; padding: 3px; }
QComboBox QListView, QComboBox QListView:focus { border: none; border-radius: 0; padding: 0; }
QTreeView::item, QListView::item { border: 0px; padding: 6px 8px; }
QTreeView::item:selected, QListView::item:selected { background: %6; color: %7; }
QHeaderView::section { background: %2; color: %4; border: none; border-bottom: 1px solid %5; padding: 6px 8px; }
QProgressBar { background: %5; border: none; border-radius: 4px; max-height: 8px; min-height: 8px; }
QProgressBar::chunk { background: %6; border-radius: 4px; }
QScrollArea { background: transparent; border: none; }
QScrollBar:vertical { background: transparent; width: 14px; margin: 2px; }
QScrollBar::handle:vertical { background: %12; border-radius: 5px; min-height: 40px; }
QScrollBar:horizontal { background: transparent; height: 14px; margin: 2px; }
QScrollBar::handle:horizontal { background: %12; border-radius: 5px; min-width: 40px; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
)");
    QString filled = sheet;
    const QColor inOrder[] = {c.background, c.surface,   c.text,        c.quietText, c.line,    c.accent,
                              c.onAccent,   c.attention, c.onAttention, c.fault,     c.onFault, c.offText};
    for (int place = static_cast<int>(std::size(inOrder)); place >= 1; --place)
        filled.replace(QStringLiteral("%%1").arg(place), inOrder[place - 1].name());
    static const QRegularExpression length(QStringLiteral("(\\d+)px"));
    if (pixels > 1)
        for (auto found = length.match(filled); found.hasMatch();) {
            const QString grown = QStringLiteral("%1px").arg(found.captured(1).toInt() * pixels);
            filled.replace(found.capturedStart(), found.capturedLength(), grown);
            found = length.match(filled, found.capturedStart() + grown.size());
        }
    return filled + typeSheetOf(basePoints) + QStringLiteral("*[weight=\"bold\"] { font-weight: bold; }\n");
}

QString typeSheetOf(double basePoints)
{
    QString sheet;
    for (const TypeRow& row : typeRows)
        sheet += QStringLiteral("*[type=\"%1\"] { font-size: %2pt; }\n").arg(row.name).arg(basePoints * row.factor, 0, 'f', 2);
    return sheet;
}

Appearance larger(Appearance appearance) { return withPercent(appearance, appearance.textPercent + percentStep); }

Appearance smaller(Appearance appearance) { return withPercent(appearance, appearance.textPercent - percentStep); }

Theme nextTheme(Theme theme)
{
    switch (theme) {
        case Theme::Light:
            return Theme::DarkRoom;
        case Theme::DarkRoom:
            return Theme::HighContrast;
        case Theme::HighContrast:
            return Theme::Light;
    }
    return Theme::Light;
}

double scaleOf(const QSize& window)
{
    constexpr double usualWidth = 1000, usualHeight = 600, step = 0.05, largest = 4;
    const double fits = std::min(window.width() / usualWidth, window.height() / usualHeight);
    // Steps, because each new size restyles every widget.
    return std::clamp(std::floor(fits / step + 1e-9) * step, 1.0, largest);
}

double textScaleOf(const QSize& window, int textPercent)
{
    constexpr double narrowest = 560, lowest = 390;
    const double largest = std::min(window.width() / narrowest, window.height() / lowest);
    return std::min(scaleOf(window) * textPercent / 100, std::max(1.0, largest));
}

double appliedEnlargement()
{
    const QVariant applied = qApp->property(enlargement);
    return applied.isValid() ? std::max(1.0, applied.toDouble()) : 1.0;
}

void applyAppearance(const Appearance& appearance, const QFont& base, const QSize& window)
{
    QFont font = base;
    font.setPointSizeF(std::max(6.0, base.pointSizeF() * textScaleOf(window, appearance.textPercent)));
    const Colours colours = coloursOf(appearance.theme);
    qApp->setProperty(enlargement, textScaleOf(window, appearance.textPercent) / scaleOf(window));
    const QString sheet = styleSheetOf(colours, font.pointSizeF(), static_cast<int>(std::lround(scaleOf(window))));
    if (qApp->styleSheet() == sheet && QApplication::font() == font) return;
    if (QApplication::style()->name().compare(QLatin1String("fusion"), Qt::CaseInsensitive) != 0)
        QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    QApplication::setPalette(paletteOf(colours));
    QApplication::setFont(font);
    qApp->setStyleSheet(sheet);
}

double contrastOf(const QColor& a, const QColor& b)
{
    const double brighter = std::max(luminanceOf(a), luminanceOf(b));
    const double darker = std::min(luminanceOf(a), luminanceOf(b));
    return (brighter + 0.05) / (darker + 0.05);
}

}  // namespace study::app
