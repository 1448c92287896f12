// The electrovibration display as a session sees it: show an image, clear it. Kinds: none (the
// session runs without a device), and a folder that a device's own program watches.
#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace rendering {

class HapticDisplay {
public:
    virtual ~HapticDisplay() = default;
    /// Throws workFailed where the device does not take it; nothing of the session is lost then.
    virtual void show(const cv::Mat& frictionImage) = 0;
    virtual void clear() = 0;
    virtual std::string name() const = 0;

    virtual bool reportsTouches() const { return false; }
    /// Called, on the thread that shows images, whenever the display begins to be touched; only where it reports touches.
    virtual void onTouched(std::function<void()>) {}
};

/// "none", or "folder:DIR" (keeps DIR/current.pgm: the image shown, all 0 while cleared; replaced by
/// rename, so that a reader never sees half of one). Throws badInput for any other.
std::unique_ptr<HapticDisplay> openDisplay(const std::string& specification);

}  // namespace rendering
