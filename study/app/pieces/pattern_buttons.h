// Buttons of the test patterns of a display. A pattern is on while its button is down; at most one is down.
#pragma once

#include <QWidget>
#include <vector>

#include "study/app/state/tried_display.h"

class QPushButton;

namespace study::app {

class PatternButtons : public QWidget {
    Q_OBJECT
public:
    explicit PatternButtons(QWidget* parent);

    /// `isConnected`: whether a display can show patterns. Without `mmPerPixel` the gratings cannot be pressed.
    void setUsable(bool isConnected, std::optional<double> mmPerPixel);
    /// Presses the button of this pattern, and releases the others.
    void setShown(const std::optional<TestPattern>& pattern);

Q_SIGNALS:
    /// The operator switches a pattern on, or the shown one off (none).
    void patternRequested(const std::optional<rendering::TestPattern>& pattern);

private:
    std::vector<QPushButton*> m_buttons;  ///< one for each of rendering::testPatterns()
};

}  // namespace study::app
