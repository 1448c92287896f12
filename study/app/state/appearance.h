// How the window looks: a light theme, a dark one for dim laboratories, and the size of all text. Colours
// keep a contrast of at least 4.5:1 for text in both themes.
#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>
#include <QString>

namespace study::app {

enum class Theme { Light, DarkRoom };

struct Appearance {
    Theme theme = Theme::Light;
    int textPercent = 100;  ///< 75..250
    bool operator==(const Appearance&) const = default;
};

/// Sizes of text, as factors of the application's font.
enum class Type { Small, Plain, Body, Lead, Words, Title, Huge };
const char* nameOf(Type type);
double factorOf(Type type);

/// The colours of a theme by what they mean.
struct Colours {
    QColor background, surface, text, quietText, line;
    QColor offText;                 ///< of what cannot be pressed now
    QColor accent, onAccent;        ///< the main action and what is chosen
    QColor attention, onAttention;  ///< refusals and hints
    QColor fault, onFault;
};
Colours coloursOf(Theme theme);

QPalette paletteOf(const Colours& colours);
/// `basePoints`: the size of plain text.
QString styleSheetOf(const Colours& colours, double basePoints);

/// The next step of text size; stays within the bounds.
Appearance larger(Appearance appearance);
Appearance smaller(Appearance appearance);

/// Sets the application's palette, style sheet and font; `base` is the font at 100 percent.
void applyAppearance(const Appearance& appearance, const QFont& base);

/// Contrast of two colours by WCAG 2.1, 1..21.
double contrastOf(const QColor& a, const QColor& b);

}  // namespace study::app
