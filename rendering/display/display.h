// The electrovibration display from the view of a session: show an image, clear it. Kinds: none (a session without a
// device), a folder that a device's own program watches, and a driver. A driver is a program of the display's owner that
// uses the protocol of display_protocol.md.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stop_token>
#include <string>

namespace rendering {

/// A finger touched the display.
struct Touch {
    std::chrono::nanoseconds ago{0};  ///< time between the touch and this report, if the device knows it
};

/// What the device measured of the finger. A value that it has no sensor for is missing; every value is finite.
struct FingerReport {
    std::chrono::nanoseconds ago{0};  ///< time between the measurement and this report
    std::optional<double> xMm, yMm;   ///< from the upper left corner of the surface
    std::optional<double> forceN;     ///< normal force
};

class HapticDisplay {
public:
    virtual ~HapticDisplay() = default;
    /// Returns when the image can be felt. Throws workFailed where the device does not show it; the session loses nothing, and
    /// the next call tries again.
    virtual void show(const cv::Mat& frictionImage) = 0;
    virtual void clear() = 0;
    virtual std::string name() const = 0;
    /// False where nothing can be felt, because the session runs without a device.
    virtual bool isThere() const { return true; }

    /// Size of the surface in pixels, if the device states it.
    virtual std::optional<cv::Size> surfacePx() const { return std::nullopt; }

    /// Whether the display turns tickets into images by itself (`vis2hap display serve`).
    virtual bool fetchesImages() const { return false; }

    virtual bool reportsTouches() const { return false; }
    /// Sets the function that is called when a finger touches the display, on the thread that shows images.
    virtual void onTouched(std::function<void(const Touch&)>) {}
    /// Sets the function that is called when the finger leaves the display. `ago` is the age of that moment.
    virtual void onReleased(std::function<void(const Touch&)>) {}
    /// Sets the function that is called with each sample of the finger while an image is shown.
    virtual void onFinger(std::function<void(const FingerReport&)>) {}

    /// File descriptor that becomes readable when the device sends something between two calls; constant for the lifetime of
    /// the display. -1 where the device never does.
    virtual int descriptorToWatch() const { return -1; }
    /// Processes waiting messages of the device without blocking. Throws workFailed where the device was lost while it showed
    /// an image, because the felt image is then uncertain.
    virtual void processMessages() {}
};

/// "none", "folder:DIR", "exec:COMMAND" (a driver that is started and uses its standard streams) or "tcp:HOST:PORT" (a
/// driver that waits for a connection). A folder holds the shown image in DIR/current.pgm, all 0 while cleared. The file is
/// replaced by rename, so a reader never sees half an image. Throws badInput for any other, workFailed for a driver that
/// does not answer. `stop` ends the wait for a driver, from any thread, and the program that was started for it.
std::unique_ptr<HapticDisplay> openDisplay(const std::string& specification, const std::stop_token& stop = {});

/// Size of the images that sessions send to every display, whatever its surface.
cv::Size sessionImagePx();

/// Whether opening this display waits for a driver, which may take seconds.
bool hasDriver(const std::string& specification);

}  // namespace rendering
