// A display whose owner's driver speaks the protocol of display_protocol.md. A driver that dies, hangs
// or babbles is started (or connected to) again, a stated number of times; then the fault is told by name.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "protocols/files/errors.h"
#include "rendering/display/display.h"
#include "rendering/display/driver_link.h"
#include "rendering/display/driver_messages.h"

namespace rendering {

struct DriverPatience {
    std::chrono::milliseconds reply{2000};  ///< from the first byte of a request to its reply
    std::chrono::milliseconds start{5000};  ///< from the start to the hello: an engine may have to come up
    int tries = 3;                          ///< of one request, the driver begun anew for each but the first
};

class ExternalDisplay final : public HapticDisplay {
public:
    /// Starts or reaches the driver and clears it. Throws workFailed.
    explicit ExternalDisplay(const DriverAddress& address, const DriverPatience& patience = {});
    ~ExternalDisplay() override;

    /// `frictionImage`: CV_8UC1.
    void show(const cv::Mat& frictionImage) override;
    void clear() override;
    std::string name() const override;
    bool reportsTouches() const override { return m_hello.touches; }
    void onTouched(std::function<void(const Touch&)> touched) override { m_touched = std::move(touched); }
    int descriptorToWatch() const override { return m_watched; }
    void attend() override;

private:
    /// What is asked, under a new id each time; `bytes` follow the line.
    struct Request {
        DriverMessage::Kind reply;
        std::function<std::string(std::int64_t id)> line;
        std::string_view bytes;
    };
    enum class Begun { Yes, NotNow, Never };
    void ask(const Request& request, int tries);
    Begun begin();
    std::optional<DriverMessage> exchange(const Request& request, std::chrono::milliseconds patience);
    std::optional<DriverMessage> heard(const std::string& line);
    void hearTouch(const DriverMessage& touch);
    void lose(const std::string& why);
    void ringIfSomethingWaits();
    protocols::Fault fault(const std::string& what) const;

    DriverAddress m_address;
    DriverPatience m_patience;
    int m_watched = -1, m_bell = -1;     ///< an epoll set, which stays while drivers come and go; rung for lines read already
    std::unique_ptr<DriverLink> m_link;  ///< empty: lost
    DriverMessage m_hello;
    std::int64_t m_lastId = 0;
    std::optional<std::int64_t> m_showing;
    bool m_isGivenUp = false;                           ///< the last request failed after all its tries
    bool m_isTimedOut = false;                          ///< the last exchange failed by its deadline, not by an ending
    std::string m_trouble, m_noise;                     ///< why the driver was lost last; the last line that was no message
    std::deque<std::chrono::nanoseconds> m_clockAhead;  ///< our clock less the device's, at the last stamps heard
    std::function<void(const Touch&)> m_touched;
};

}  // namespace rendering
