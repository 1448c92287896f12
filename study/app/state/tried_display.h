// The display while the operator sets it up: connects it, shows test patterns on it, and clears it. Also what the settings
// remember of it.
#pragma once

#include <QObject>
#include <QSocketNotifier>
#include <QString>
#include <memory>
#include <optional>
#include <string>

#include "rendering/display/display.h"
#include "rendering/display/test_patterns.h"
#include "study/app/state/app_options.h"
#include "study/app/state/display_opening.h"

class QSettings;

namespace study::app {

using rendering::TestPattern;

/// The name of a pattern as the pages show it.
QString patternName(const TestPattern& pattern);

/// Whether the display leaves each image as a plain file that an operator could open.
bool leavesPlainImages(const std::string& specification);

/// Specification of the display that was connected last; empty if none is stored. `settings` may be null.
std::string rememberedDisplay(const QSettings* settings);
void rememberDisplay(QSettings* settings, const std::string& specification);
/// Pixels of a display are smaller than this.
inline constexpr double largestMmPerPixel = 10;
/// Scale of this display, mm per pixel, if the operator entered one; a number that no display has is left out.
std::optional<double> rememberedScale(const QSettings* settings, const std::string& specification);
void rememberScale(QSettings* settings, const std::string& specification, double mmPerPixel);

class TriedDisplay : public QObject {
    Q_OBJECT
public:
    TriedDisplay(OpenDisplay open, QObject* parent);
    ~TriedDisplay() override;

    /// Closes the display that was connected, and connects this one: opened() or failed() follows, at once where no driver is
    /// waited for.
    void connectTo(const std::string& specification);
    bool isConnecting() const { return m_opening.isOpening(); }
    /// Stops connecting. Clears the display and closes it. Nothing is left to feel, because a driver clears its device when the
    /// connection ends.
    void close();
    bool isConnected() const { return static_cast<bool>(m_display); }
    /// The connected display; null if none.
    const rendering::HapticDisplay* display() const { return m_display.get(); }

    /// Shows the pattern until clear(). Throws protocols::Error; then no pattern counts as shown, and the display is closed if it
    /// may still show something.
    void show(const TestPattern& pattern, std::optional<double> mmPerPixel);
    void clear();
    const std::optional<TestPattern>& shown() const { return m_shown; }

Q_SIGNALS:
    void opened();
    /// The display cannot be connected.
    void failed(const QString& fault);
    /// The display was lost while a pattern was shown. It is closed now.
    void lost(const QString& fault);
    void touched();

private:
    void attend();
    void use(std::unique_ptr<rendering::HapticDisplay> display);

    DisplayOpening m_opening;
    std::unique_ptr<rendering::HapticDisplay> m_display;
    std::unique_ptr<QSocketNotifier> m_watch;  ///< declared after the display, so destroyed before it
    std::optional<TestPattern> m_shown;
};

}  // namespace study::app
