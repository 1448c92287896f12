#include "study/participant/page_access.h"

#include <utility>

#include "protocols/files/sha256.h"

namespace study::participant {

namespace {

constexpr std::int64_t secondNs = 1'000'000'000;

/// Takes as long for every pair of texts of this length, so that time tells nothing about the first difference.
bool areEqual(std::string_view a, std::string_view b)
{
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

}  // namespace

PageAccess::PageAccess(std::function<std::string()> drawSecret, AccessLimits limits)
    : m_drawSecret(std::move(drawSecret)), m_limits(limits)
{
}

void PageAccess::setCode(const std::string& code)
{
    m_code = code;
    m_sessionHash.clear();
    m_wrongCodes = 0;
    m_waitUntilNs.reset();
}

void PageAccess::restore(const std::string& sessionHash)
{
    m_sessionHash = sessionHash;
    m_code.clear();
}

PageAccess::Entry PageAccess::enter(std::string_view code, std::int64_t nowNs)
{
    using Why = Refused::Why;
    if (hasDevice()) return Refused{Why::AnotherDevice};
    if (m_code.empty()) return Refused{Why::CodeIsVoid};
    if (m_waitUntilNs && nowNs < *m_waitUntilNs)
        return Refused{Why::Wait, std::chrono::seconds((*m_waitUntilNs - nowNs + secondNs - 1) / secondNs)};
    if (areEqual(code, m_code)) {
        const std::string secret = m_drawSecret();
        m_sessionHash = protocols::sha256(secret);
        m_code.clear();  // a code is good for one browser
        return Entered{secret, m_sessionHash};
    }
    ++m_wrongCodes;
    if (m_wrongCodes >= m_limits.tries) {
        m_code.clear();
        return Refused{Why::CodeIsVoid};
    }
    if (m_wrongCodes < m_limits.triesBeforeWaiting) return Refused{Why::WrongCode};
    m_waitUntilNs = nowNs + m_limits.wait.count() * secondNs;
    return Refused{Why::Wait, m_limits.wait};
}

bool PageAccess::isIn(std::string_view secret) const { return hasDevice() && areEqual(protocols::sha256(secret), m_sessionHash); }

}  // namespace study::participant
