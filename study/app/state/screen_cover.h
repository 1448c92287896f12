// A touch screen that carries the display's film: covered by a black window, so that nothing can be seen where it is
// stroked, and asked when it is touched. What is felt there is another display's business, which it wraps.
#pragma once

#include <memory>
#include <string>

#include "rendering/display/display.h"

class QScreen;
class QWidget;

namespace study::app {

class ScreenCover final : public rendering::HapticDisplay {
public:
    /// Covers the screen as long as it lives. A QApplication must exist.
    ScreenCover(std::unique_ptr<rendering::HapticDisplay> felt, QScreen& screen);
    ~ScreenCover() override;

    /// Throws workFailed too where the screen was disconnected.
    void show(const cv::Mat& frictionImage) override;
    void clear() override { m_felt->clear(); }
    std::string name() const override;
    bool reportsTouches() const override { return true; }
    /// Touches of a finger and presses of a mouse alike, and those that the display under the cover tells.
    void onTouched(std::function<void(const rendering::Touch&)> touched) override;
    int descriptorToWatch() const override { return m_felt->descriptorToWatch(); }
    void processMessages() override { m_felt->processMessages(); }

private:
    class Window;
    std::unique_ptr<rendering::HapticDisplay> m_felt;
    std::unique_ptr<Window> m_window;
};

/// What rendering::openDisplay takes, and "cover:N" for the screen N (0 is the main one), alone or behind another kind:
/// "folder:DIR,cover:1", "exec:COMMAND,cover:1". Throws badInput for a screen that is not there, or where no other is left for
/// the console.
std::unique_ptr<rendering::HapticDisplay> openDisplay(const std::string& specification);

}  // namespace study::app
