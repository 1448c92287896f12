// Appearance of the window: a light theme, a dark theme for dim laboratories, and the size of all text. Text has a contrast
// of at least 4.5:1 in both themes.
#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>
#include <QString>

namespace study::app {

enum class Theme { Light, DarkRoom };

struct Appearance {
    Theme theme = Theme::Light;
    int textPercent = 100;  ///< text size in percent, 75–250
    bool operator==(const Appearance&) const = default;
};

/// Text sizes; factorOf() gives them relative to the application's font.
enum class Type { Small, Plain, Body, Lead, Words, Title, Huge };
const char* nameOf(Type type);
double factorOf(Type type);

/// Colours of a theme, named by their use.
struct Colours {
    QColor background, surface, text, quietText, line;
    QColor offText;                 ///< text of disabled controls
    QColor accent, onAccent;        ///< main action and selection
    QColor attention, onAttention;  ///< refusals and hints
    QColor fault, onFault;
};
Colours coloursOf(Theme theme);

QPalette paletteOf(const Colours& colours);
/// Style sheet of the application. `basePoints`: size of plain text, pt.
QString styleSheetOf(const Colours& colours, double basePoints);

/// Appearance with the next text size, within 75–250 %.
Appearance larger(Appearance appearance);
Appearance smaller(Appearance appearance);

/// Sets the palette, style sheet and font of the application. `base`: the font at 100 %.
void applyAppearance(const Appearance& appearance, const QFont& base);

/// Contrast ratio of two colours by WCAG 2.1, 1–21.
double contrastOf(const QColor& a, const QColor& b);

}  // namespace study::app
