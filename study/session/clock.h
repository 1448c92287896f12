// Time as a session sees it: a monotonic clock for response times and the wall clock for the record.
// Injected, so that scripted time is virtual and a stepped system clock changes nothing.
#pragma once

#include <cstdint>
#include <string>

namespace study::session {

class Clock {
public:
    virtual ~Clock() = default;
    virtual std::int64_t monotonicNs() const = 0;
    virtual std::string wallTime() const = 0;  ///< ISO 8601 with milliseconds and zone
};

class SystemClock final : public Clock {
public:
    std::int64_t monotonicNs() const override;
    std::string wallTime() const override;
};

/// Stands still until it is moved; wall time goes along from a fixed start.
class VirtualClock final : public Clock {
public:
    std::int64_t monotonicNs() const override { return m_nowNs; }
    std::string wallTime() const override;
    void advanceSeconds(double seconds);

private:
    std::int64_t m_nowNs = 0;
};

}  // namespace study::session
