// Who may use the participant's page: the first browser that enters the drawn code, and no other until a new code is drawn. Codes
// cannot be tried out: after five wrong ones each further try waits, after ten the code is void. Holds no clock; times come in.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace study::participant {

struct AccessLimits {
    int triesBeforeWaiting = 5;
    int tries = 10;  ///< wrong codes until the code is void
    std::chrono::seconds wait{30};
};

class PageAccess {
public:
    /// `drawSecret`: makes the secret of a session, which only the browser and this object know.
    PageAccess(std::function<std::string()> drawSecret, AccessLimits limits);

    /// Takes a new code. The browser that was in is out.
    void setCode(const std::string& code);
    /// Lets the browser with this session stay in after a restart of the program. `sessionHash`: from Entered.
    void restore(const std::string& sessionHash);

    struct Entered {
        std::string secret;       ///< for the cookie of the browser
        std::string sessionHash;  ///< SHA-256 of the secret
    };
    struct Refused {
        enum class Why { WrongCode, Wait, CodeIsVoid, AnotherDevice } why = Why::WrongCode;
        std::chrono::seconds wait{0};  ///< until the next try
    };
    using Entry = std::variant<Entered, Refused>;
    /// `nowNs`: any monotonic clock.
    Entry enter(std::string_view code, std::int64_t nowNs);

    bool isIn(std::string_view secret) const;
    bool hasDevice() const { return !m_sessionHash.empty(); }
    int wrongCodes() const { return m_wrongCodes; }

private:
    std::function<std::string()> m_drawSecret;
    AccessLimits m_limits;
    std::string m_code;         ///< empty: none is valid
    std::string m_sessionHash;  ///< of the browser that is in; empty: none
    int m_wrongCodes = 0;
    std::optional<std::int64_t> m_waitUntilNs;
};

}  // namespace study::participant
