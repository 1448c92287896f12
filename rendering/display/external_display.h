// A display whose owner's driver uses the protocol of display_protocol.md. A driver that ends, hangs or sends nonsense
// is started (or connected to) again, a fixed number of times. Then the fault is thrown.
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "protocols/files/errors.h"
#include "rendering/display/device_clock.h"
#include "rendering/display/display.h"
#include "rendering/display/driver_link.h"
#include "rendering/display/driver_messages.h"

namespace rendering {

struct DriverPatience {
    std::chrono::milliseconds reply{2000};  ///< from the first byte of a request to its reply
    std::chrono::milliseconds start{5000};  ///< from the start to the hello, because a device may need time to start
    int tries = 3;                          ///< for one request; the driver is started again before each further try
    std::stop_token stop = {};              ///< ends every wait; the request then fails
};

class ExternalDisplay final : public HapticDisplay {
public:
    /// Starts or connects to the driver and clears it. Throws workFailed.
    explicit ExternalDisplay(const DriverAddress& address, const DriverPatience& patience = {});
    ~ExternalDisplay() override;

    /// `frictionImage`: CV_8UC1.
    void show(const cv::Mat& frictionImage) override;
    void clear() override;
    std::string name() const override;
    std::optional<cv::Size> surfacePx() const override { return cv::Size(m_hello.widthPx, m_hello.heightPx); }
    bool fetchesImages() const override { return m_hello.fetches; }
    bool reportsTouches() const override { return m_hello.touches; }
    void onTouched(std::function<void(const Touch&)> touched) override { m_touched = std::move(touched); }
    void onReleased(std::function<void(const Touch&)> released) override { m_released = std::move(released); }
    void onFinger(std::function<void(const FingerReport&)> finger) override { m_finger = std::move(finger); }
    int descriptorToWatch() const override { return m_watched; }
    void processMessages() override;

private:
    /// A request, which gets a new id for each try; `bytes` follow the line.
    struct DriverRequest {
        MessageKind reply;
        std::function<std::string(std::int64_t id)> line;
        std::string_view bytes;
    };
    enum class StartResult { Started, TryAgain, GiveUp };
    void ask(const DriverRequest& request, int tries);
    StartResult start();
    std::optional<DriverMessage> exchange(const DriverRequest& request, std::chrono::milliseconds patience);
    std::optional<DriverMessage> received(const std::string& line);
    std::optional<Instant> askedBefore(const DriverMessage& message) const;
    std::chrono::nanoseconds ageOf(const DriverMessage& message, Instant readAt) const;
    void reportTouch(const std::function<void(const Touch&)>& report, const DriverMessage& touch, Instant readAt);
    void reportFinger(const DriverMessage& sample, Instant readAt) const;
    void lose(const std::string& why);
    void wakeIfLinesWait();
    protocols::Fault fault(const std::string& what) const;

    DriverAddress m_address;
    DriverPatience m_patience;
    int m_watched = -1, m_wake = -1;     ///< an epoll set that outlives drivers, and an event in it for lines read ahead
    std::unique_ptr<DriverLink> m_link;  ///< null while the driver is lost
    DriverMessage m_hello;
    std::int64_t m_lastId = 0;
    std::optional<std::int64_t> m_showing;
    bool m_isGivenUp = false;          ///< the last request failed after all its tries
    bool m_isTimedOut = false;         ///< the last exchange failed by its deadline; the driver did not end
    std::string m_trouble, m_noise;    ///< reason of the last loss; the last line that was not a message
    DeviceClock m_clock;               ///< by the time stamps of this driver
    Instant m_askedAt, m_showAskedAt;  ///< when the last request was sent, and that of the shown image
    Instant m_shownAt;                 ///< when the reply `shown` of the shown image was read
    std::function<void(const Touch&)> m_touched, m_released;
    std::function<void(const FingerReport&)> m_finger;
};

}  // namespace rendering
