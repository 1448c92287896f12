#include "rendering/display/device_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace rendering {

namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t stampsKept = 8;  // Few, so that a drift between the clocks does not accumulate.
constexpr nanoseconds oldestEvent = std::chrono::seconds(2);
constexpr nanoseconds clockTolerance = milliseconds(20);

// A sound clock may tick every 10 to 25 ms, and up to half of its stamps then look rounded to more than 30 ms. The shares below
// come from a simulation of presentations with three stamps each: shown, touched, cleared.
// Sound clocks: all of the last 16 stamps look rounded in 1 of 65,000 presentations at ticks of 25 ms or 1/64 s. At 1/60 s and at
// 10 ms that never happened. The first presentation of a connection has only three stamps. It loses its age in 1 % of the
// connections at 10 ms, in 3 % at 1/60 s and in 12 % at 25 ms. The second one loses it in 1 % at 25 ms. A lost age does little
// harm: the touch then counts as read at once. A wrong age would lengthen the response time.
// Rounded clocks: every one was found from the first touch on. These were six digits of a Unix time, and decimal units from
// 0.05 s. They were also 32 bits of a Unix time, and 32 bits of the seconds since a start three days ago.
constexpr int stampsForAges = 2, lastStampsForAges = 16;
// The check has about 45 stamps. Not one of 4,000 simulated checks of each sound clock had only stamps that look rounded.
constexpr int stampsForTheCheck = 12, allStamps = std::numeric_limits<int>::max();

nanoseconds deviceTime(const StampedEvent& event)
{
    return duration_cast<nanoseconds>(std::chrono::duration<double>(event.deviceS));
}

/// Our clock minus the device's, if the event happened at this moment.
nanoseconds aheadAt(Instant moment, const StampedEvent& event) { return moment.time_since_epoch() - deviceTime(event); }

bool isMultiple(double seconds, int perSecond)
{
    constexpr double tolerance = 1e-3;
    const double units = seconds * perSecond;
    return std::abs(units - std::round(units)) < tolerance;
}

/// 50 ms holds every coarser decimal unit.
bool isDecimal(double seconds) { return isMultiple(seconds, 20); }
/// 1/32 s holds every coarser step of a binary number.
bool isBinary(double seconds) { return isMultiple(seconds, 32); }

std::string thousandths(nanoseconds duration)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3f s", std::chrono::duration<double>(duration).count());
    return text;
}

/// `earliest` cannot have happened before its request, nor `latest` after its message, so the clocks have moved apart.
std::string faultBetween(const StampedEvent& earliest, const StampedEvent& latest)
{
    if (latest.readAt >= earliest.readAt)
        return "at_s advanced by " + thousandths(deviceTime(latest) - deviceTime(earliest)) + " within " +
               thousandths(latest.readAt - *earliest.notBefore);
    const nanoseconds moved = deviceTime(earliest) - deviceTime(latest);
    return std::string("at_s ") + (moved.count() < 0 ? "went back by " : "advanced by ") + thousandths(std::chrono::abs(moved)) +
           " while " + thousandths(*earliest.notBefore - latest.readAt) + " passed";
}

}  // namespace

void RoundedStamps::take(double deviceS)
{
    ++m_taken;
    m_decimal = isDecimal(deviceS) ? m_decimal + 1 : 0;
    m_binary = isBinary(deviceS) ? m_binary + 1 : 0;
}

bool RoundedStamps::areAll(int fewest, int last) const
{
    const int needed = std::max(fewest, std::min(m_taken, last));
    return m_decimal >= needed || m_binary >= needed;
}

void DeviceClock::take(const StampedEvent& event)
{
    const nanoseconds device = deviceTime(event);
    m_hasRun = m_hasRun || (m_last && device > m_last->device);
    // A touch may come in the moment of its image and be read late. Only the reply to a later request must have a later stamp.
    const bool mustBeLater = m_last && event.notBefore && *event.notBefore > m_last->readAt + clockTolerance;
    if (mustBeLater) m_stands = device <= m_last->device;
    if (mustBeLater && m_stands) m_ahead.clear();
    // No event happens before its request, so where these stamps say so, the clock has been set back since.
    if (event.notBefore) std::erase_if(m_ahead, [&](nanoseconds ahead) { return ahead < aheadAt(*event.notBefore, event); });
    m_ahead.push_back(aheadAt(event.readAt, event));
    if (m_ahead.size() > stampsKept) m_ahead.pop_front();
    m_last = {device, event.readAt};
    m_rounded.take(event.deviceS);
}

nanoseconds DeviceClock::ageOf(const StampedEvent& event) const
{
    if (m_ahead.empty() || !m_hasRun || m_stands || m_rounded.areAll(stampsForAges, lastStampsForAges)) return {};
    const nanoseconds age = aheadAt(event.readAt, event) - *std::min_element(m_ahead.begin(), m_ahead.end());
    if (event.notBefore && age > event.readAt - *event.notBefore) return {};
    return std::clamp(age, nanoseconds(0), oldestEvent);
}

void DeviceClockCheck::restart()
{
    m_earliest.reset();
    m_latest.reset();
}

void DeviceClockCheck::take(const StampedEvent& event)
{
    m_hasStamps = true;
    m_rounded.take(event.deviceS);
    if (!m_latest || aheadAt(event.readAt, event) < aheadAt(m_latest->readAt, *m_latest)) m_latest = event;
    if (event.notBefore && (!m_earliest || aheadAt(*event.notBefore, event) > aheadAt(*m_earliest->notBefore, *m_earliest)))
        m_earliest = event;
    if (!m_earliest || !m_fault.empty()) return;
    if (aheadAt(*m_earliest->notBefore, *m_earliest) > aheadAt(m_latest->readAt, *m_latest) + clockTolerance)
        m_fault = faultBetween(*m_earliest, *m_latest);
}

std::string DeviceClockCheck::fault() const
{
    if (!m_fault.empty() || !m_rounded.areAll(stampsForTheCheck, allStamps)) return m_fault;
    return "at_s is rounded to 0.03 s or more; send at least three decimals";
}

}  // namespace rendering
