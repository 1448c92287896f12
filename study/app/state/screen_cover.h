// Touch screen under the film of a haptic display. A black window covers the screen, so that the participant sees nothing
// there, and reports touches. The wrapped display renders the sensation.
#pragma once

#include <memory>
#include <string>

#include "rendering/display/display.h"

class QScreen;
class QWidget;

namespace study::app {

class ScreenCover final : public rendering::HapticDisplay {
public:
    /// Covers the screen during the lifetime of this object. A QApplication must exist.
    ScreenCover(std::unique_ptr<rendering::HapticDisplay> wrapped, QScreen& screen);
    ~ScreenCover() override;

    /// Also throws workFailed if the screen was disconnected.
    void show(const cv::Mat& frictionImage) override;
    void clear() override { m_wrapped->clear(); }
    std::string name() const override;
    bool fetchesImages() const override { return m_wrapped->fetchesImages(); }
    bool reportsTouches() const override { return true; }
    std::optional<cv::Size> surfacePx() const override { return m_wrapped->surfacePx(); }
    bool isThere() const override { return m_wrapped->isThere(); }
    /// Reports touches by a finger, presses of the mouse, and touches that the wrapped display reports.
    void onTouched(std::function<void(const rendering::Touch&)> touched) override;
    void onReleased(std::function<void(const rendering::Touch&)> released) override
    {
        m_wrapped->onReleased(std::move(released));
    }
    void onFinger(std::function<void(const rendering::FingerReport&)> finger) override { m_wrapped->onFinger(std::move(finger)); }
    int descriptorToWatch() const override { return m_wrapped->descriptorToWatch(); }
    void processMessages() override { m_wrapped->processMessages(); }

private:
    class Window;
    std::unique_ptr<rendering::HapticDisplay> m_wrapped;
    std::unique_ptr<Window> m_window;
};

/// Opens a display. Accepts every specification of rendering::openDisplay. "cover:N" covers screen N (0 is the main screen);
/// it stands alone or after another display: "folder:DIR,cover:1", "exec:COMMAND,cover:1". Throws badInput if screen N does
/// not exist or if no screen is left for the console. `stop`: see rendering::openDisplay().
std::unique_ptr<rendering::HapticDisplay> openDisplay(const std::string& specification, const std::stop_token& stop = {});

/// The display under the cover: "exec:COMMAND,cover:1" gives "exec:COMMAND", "cover:1" gives "none".
std::string coveredDisplay(const std::string& specification);
/// Covers the screen that `specification` names, if it names one. Throws like openDisplay(). `display` may be null: then it is
/// only checked that the screen can be covered.
std::unique_ptr<rendering::HapticDisplay> withCover(std::unique_ptr<rendering::HapticDisplay> display,
                                                    const std::string& specification);

}  // namespace study::app
