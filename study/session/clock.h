// The clocks of a session: a monotonic clock for response times and the wall clock for the record. The session gets them from
// outside, so that scripted sessions have virtual time and a change of the system clock has no effect.
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

/// Stands still until it is advanced. Its wall time starts at a fixed instant.
class VirtualClock final : public Clock {
public:
    std::int64_t monotonicNs() const override { return m_nowNs; }
    std::string wallTime() const override;
    void advanceSeconds(double seconds);

private:
    std::int64_t m_nowNs = 0;
};

}  // namespace study::session
