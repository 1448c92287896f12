// Opens a haptic display. A driver may need seconds to answer, so a worker thread waits for it and the window stays responsive.
#pragma once

#include <exception>
#include <memory>
#include <stop_token>
#include <utility>

#include "rendering/display/display.h"
#include "study/app/state/app_options.h"
#include "study/app/state/in_background.h"
#include "study/app/state/screen_cover.h"

namespace study::app {

class DisplayOpening {
public:
    using Opened = std::function<void(std::unique_ptr<rendering::HapticDisplay>)>;
    using Failed = InBackground::Failed;

    explicit DisplayOpening(OpenDisplay open) : m_open(std::move(open)) {}
    ~DisplayOpening() { stop(); }
    DisplayOpening(const DisplayOpening&) = delete;
    DisplayOpening& operator=(const DisplayOpening&) = delete;

    /// Stops the current attempt and opens this display. Calls one of both functions on the window's thread: at once for a
    /// display without a driver, later for one with a driver. Neither is called after stop().
    void open(const std::string& specification, Opened opened, Failed failed)
    {
        stop();
        if (rendering::hasDriver(coveredDisplay(specification)))
            openLater(specification, std::move(opened), std::move(failed));
        else
            openNow(specification, opened, failed);
    }
    /// Ends the attempt and a driver program that was started for it. Takes less than half a second.
    void stop()
    {
        m_stop.request_stop();
        m_work.stop();
    }
    bool isOpening() const { return m_work.isBusy(); }

private:
    void openNow(const std::string& specification, const Opened& opened, const Failed& failed)
    {
        std::unique_ptr<rendering::HapticDisplay> display;
        try {
            display = m_open(specification, {});
        } catch (const std::exception& fault) {
            return failed(QString::fromUtf8(fault.what()));
        }
        opened(std::move(display));
    }

    void openLater(const std::string& specification, Opened opened, Failed failed)
    {
        m_stop = std::stop_source();
        try {
            withCover(nullptr, specification);  // A wrong screen is reported before the driver is started.
        } catch (const std::exception& fault) {
            return failed(QString::fromUtf8(fault.what()));
        }
        const auto work = [=, this, open = m_open, token = m_stop.get_token()](const std::atomic<bool>&) -> InBackground::Then {
            using Display = std::unique_ptr<rendering::HapticDisplay>;
            const auto display = std::make_shared<Display>(open(coveredDisplay(specification), token));
            // Only the window's thread may make the window that covers a screen.
            return [=, this] {
                m_stop = std::stop_source();  // The opened display must not end with the next attempt.
                try {
                    *display = withCover(std::move(*display), specification);
                } catch (const std::exception& fault) {
                    return failed(QString::fromUtf8(fault.what()));
                }
                opened(std::move(*display));
            };
        };
        m_work.run(work, failed);
    }

    OpenDisplay m_open;
    std::stop_source m_stop;
    InBackground m_work;
};

}  // namespace study::app
