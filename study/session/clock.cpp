#include "study/session/clock.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace study::session {

namespace {

/// "2026-01-31T09:00:00.250+01:00"
std::string isoLocal(std::int64_t msSinceEpoch)
{
    const std::time_t seconds = static_cast<std::time_t>(msSinceEpoch / 1000);
    std::tm local{};
    ::localtime_r(&seconds, &local);
    std::array<char, 24> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &local);
    const long offsetMinutes = local.tm_gmtoff / 60;
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s.%03d%c%02ld:%02ld", date.data(), static_cast<int>(msSinceEpoch % 1000),
                  offsetMinutes < 0 ? '-' : '+', std::labs(offsetMinutes) / 60, std::labs(offsetMinutes) % 60);
    return text.data();
}

/// Virtual sessions begin at 2000-01-01T00:00:00Z, so that nobody mistakes them for real ones.
constexpr std::int64_t virtualStartMs = 946684800000;

std::string isoUtc(std::int64_t msSinceEpoch)
{
    const std::time_t seconds = static_cast<std::time_t>(msSinceEpoch / 1000);
    std::tm utc{};
    ::gmtime_r(&seconds, &utc);
    std::array<char, 24> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &utc);
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s.%03dZ", date.data(), static_cast<int>(msSinceEpoch % 1000));
    return text.data();
}

}  // namespace

std::int64_t SystemClock::monotonicNs() const
{
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string SystemClock::wallTime() const
{
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return isoLocal(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

std::string VirtualClock::wallTime() const { return isoUtc(virtualStartMs + m_nowNs / 1000000); }

void VirtualClock::advanceSeconds(double seconds) { m_nowNs += std::llround(seconds * 1e9); }

}  // namespace study::session
