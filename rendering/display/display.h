// The electrovibration display as a session sees it: show an image, clear it. Kinds: none (the
// session runs without a device), a folder that a device's own program watches, and a driver: a
// program of the display's owner that speaks the protocol of display_protocol.md.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

namespace rendering {

/// A finger came down on the display.
struct Touch {
    std::chrono::nanoseconds ago{0};  ///< how long before it was told here, where the device knows
};

class HapticDisplay {
public:
    virtual ~HapticDisplay() = default;
    /// Returns when the image can be felt. Throws workFailed where the device does not take it; nothing of
    /// the session is lost then, and the next call tries anew.
    virtual void show(const cv::Mat& frictionImage) = 0;
    virtual void clear() = 0;
    virtual std::string name() const = 0;

    virtual bool reportsTouches() const { return false; }
    /// Called, on the thread that shows images, whenever the display begins to be touched; only where it reports touches.
    virtual void onTouched(std::function<void(const Touch&)>) {}

    /// Can be read whenever the device has something to tell between two calls, and stays the same as long
    /// as the display lives; -1 where it never has.
    virtual int descriptorToWatch() const { return -1; }
    /// Takes in what the device tells unasked, without waiting. Throws workFailed where the device was lost
    /// while it showed an image: what was being felt is not to be trusted.
    virtual void attend() {}
};

/// "none"; "folder:DIR" (keeps DIR/current.pgm: the image shown, all 0 while cleared; replaced by rename,
/// so that a reader never sees half of one); "exec:COMMAND" (a driver that is started here and speaks over
/// its standard streams); "tcp:HOST:PORT" (a driver that waits for us). Throws badInput for any other,
/// workFailed for a driver that does not answer.
std::unique_ptr<HapticDisplay> openDisplay(const std::string& specification);

}  // namespace rendering
