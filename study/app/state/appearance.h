// Appearance of the window: a light theme, a dark theme for dim laboratories, one of high contrast, and the size of all text.
// Text has a contrast of at least 4.5:1 in every theme, and of 7:1 in that of high contrast.
#pragma once

#include <QColor>
#include <QFont>
#include <QPalette>
#include <QSize>
#include <QString>

namespace study::app {

enum class Theme { Light, DarkRoom, HighContrast };

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
/// Style sheet of the application. `basePoints`: size of plain text, pt. `pixels`: factor of borders and paddings, 1 or more.
QString styleSheetOf(const Colours& colours, double basePoints, int pixels);
/// The part of a style sheet that sets the sizes of all types.
QString typeSheetOf(double basePoints);

/// Appearance with the next text size, within 75–250 %.
Appearance larger(Appearance appearance);
Appearance smaller(Appearance appearance);

/// The theme that follows: light, dark room, high contrast, light.
Theme nextTheme(Theme theme);

/// Factor by which text and pages grow with a window of this size, px: 1 up to 1000 x 600, at most 4, in steps of 0.05.
double scaleOf(const QSize& window);

/// Factor of the text: the window's, times the user's choice, as far as a question and its answer still fit into the window.
double textScaleOf(const QSize& window, int textPercent);

/// By how much the user enlarges text beyond 100 % in the window of the last applyAppearance(): 1 or more.
double appliedEnlargement();

/// Sets the palette, style sheet and font of the application. `base`: the font at 100 %. `window`: size of the main window, px.
void applyAppearance(const Appearance& appearance, const QFont& base, const QSize& window = QSize(1000, 600));

/// Contrast ratio of two colours by WCAG 2.1, 1–21.
double contrastOf(const QColor& a, const QColor& b);

}  // namespace study::app
