// A device's clock against ours, from the time stamps of its messages. A stamp can say how long its message was under way only
// if the clock is fine and runs on. Stamps that are rounded, stand still or run back give no age.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>

#include "rendering/display/driver_link.h"

namespace rendering {

/// An event that the device stamped by its own clock.
struct StampedEvent {
    double deviceS = 0;                ///< its stamp, s
    Instant readAt;                    ///< when we read its message
    std::optional<Instant> notBefore;  ///< when we sent the request that it follows from, if that is known
};

/// Whether stamps are all whole multiples of a coarse unit, as a rounded text or a 32-bit number gives them.
class RoundedStamps {
public:
    void take(double deviceS);
    /// Whether the `last` stamps, or all where fewer were taken, look rounded to more than 30 ms. Never for less than `fewest`.
    bool areAll(int fewest, int last) const;

private:
    int m_taken = 0;
    int m_decimal = 0, m_binary = 0;  ///< stamps in a row that look rounded, by unit
};

class DeviceClock {
public:
    /// The message of this event was read.
    void take(const StampedEvent& event);
    /// Time from the event until its message was read, at most 2 s. The fastest of the last eight messages gives the difference
    /// between the clocks. 0 where the stamps cannot tell.
    std::chrono::nanoseconds ageOf(const StampedEvent& event) const;

private:
    struct Last {
        std::chrono::nanoseconds device;
        Instant readAt;
    };
    std::deque<std::chrono::nanoseconds> m_ahead;  ///< our clock minus the device's for the last stamps
    std::optional<Last> m_last;
    bool m_hasRun = false;  ///< a stamp was above the one before
    bool m_stands = false;  ///< the reply to a request was not stamped later than the event before that request
    RoundedStamps m_rounded;
};

/// Compares a device's clock with ours over all its events, for the check of a driver.
class DeviceClockCheck {
public:
    /// A connection begins; the device may have started again.
    void restart();
    void take(const StampedEvent& event);
    bool hasStamps() const { return m_hasStamps; }
    /// How the stamps differ from our clock by more than 20 ms; empty where they do not.
    std::string fault() const;

private:
    std::optional<StampedEvent> m_earliest, m_latest;  ///< the events that bound the difference between the clocks
    bool m_hasStamps = false;
    std::string m_fault;
    RoundedStamps m_rounded;
};

}  // namespace rendering
