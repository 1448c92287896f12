#include "database/server/client_library.h"

#include <dlfcn.h>
#include <locale.h>
#include <poll.h>

#include <chrono>

namespace database {

namespace {

// The declarations below are those of libpq-fe.h, whose package is not needed otherwise. They are the library's binary
// interface 5.
struct ClientConnection;

struct ClientOption {
    char* keyword;
    char* variable;
    char* compiled;
    char* value;
    char* label;
    char* display;
    int size;
};

enum class Polled : int { Failed, Reading, Writing, Open };

constexpr int codesOnly = 3;  ///< PQERRORS_SQLSTATE: a message is "SEVERITY:  CODE"
constexpr std::size_t codeLength = 5;
constexpr auto longestAttempt = std::chrono::seconds(4);

template <class Function>
Function* clientFunction(const char* name)
{
    static void* const library = ::dlopen("libpq.so.5", RTLD_NOW);
    return library == nullptr ? nullptr : reinterpret_cast<Function*>(::dlsym(library, name));
}

bool isReady(int socket, Polled wanted, std::chrono::milliseconds patience)
{
    pollfd watched{socket, static_cast<short>(wanted == Polled::Reading ? POLLIN : POLLOUT), 0};
    return ::poll(&watched, 1, static_cast<int>(patience.count())) > 0;
}

/// Follows the attempt until the server has answered.
void follow(ClientConnection* connection)
{
    const auto step = clientFunction<int(ClientConnection*)>("PQconnectPoll");
    const auto socketOf = clientFunction<int(const ClientConnection*)>("PQsocket");
    const auto end = std::chrono::steady_clock::now() + longestAttempt;
    for (auto state = Polled::Writing; state == Polled::Writing || state == Polled::Reading;
         state = static_cast<Polled>(step(connection))) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        if (left.count() <= 0 || !isReady(socketOf(connection), state, left)) return;
    }
}

/// The code at the end of a message of the form "…SEVERITY:  CODE".
std::string codeIn(std::string message)
{
    while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) message.pop_back();
    const auto place = message.rfind(":  ");
    if (place == std::string::npos || message.size() - place - 3 != codeLength) return {};
    const std::string code = message.substr(place + 3);
    return code.find_first_not_of("0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos ? code : std::string();
}

}  // namespace

std::optional<std::map<std::string, std::string>> clientDefaults()
{
    const auto defaults = clientFunction<ClientOption*()>("PQconndefaults");
    const auto free = clientFunction<void(ClientOption*)>("PQconninfoFree");
    ClientOption* const options = defaults != nullptr && free != nullptr ? defaults() : nullptr;
    if (options == nullptr) return std::nullopt;
    std::map<std::string, std::string> values;
    for (const ClientOption* option = options; option->keyword != nullptr; ++option)
        if (option->value != nullptr) values[option->keyword] = option->value;
    free(options);
    return values;
}

std::string codeOfRefusal(const std::string& settings)
{
    const auto start = clientFunction<ClientConnection*(const char*)>("PQconnectStart");
    const auto speak = clientFunction<int(ClientConnection*, int)>("PQsetErrorVerbosity");
    const auto messageOf = clientFunction<const char*(const ClientConnection*)>("PQerrorMessage");
    const auto finish = clientFunction<void(ClientConnection*)>("PQfinish");
    if (start == nullptr || speak == nullptr || messageOf == nullptr || finish == nullptr) return {};
    ClientConnection* const connection = start(settings.c_str());
    if (connection == nullptr) return {};
    speak(connection, codesOnly);
    follow(connection);
    const std::string code = codeIn(messageOf(connection));
    finish(connection);
    return code;
}

int toldProcessOf(const void* connection)
{
    const auto processOf = clientFunction<int(const ClientConnection*)>("PQbackendPID");
    return processOf == nullptr || connection == nullptr ? 0 : processOf(static_cast<const ClientConnection*>(connection));
}

EnglishMessages::EnglishMessages() : m_english(::newlocale(LC_MESSAGES_MASK, "C", ::duplocale(LC_GLOBAL_LOCALE)))
{
    if (m_english != nullptr) m_before = ::uselocale(static_cast<locale_t>(m_english));
}

EnglishMessages::~EnglishMessages()
{
    if (m_english == nullptr) return;
    ::uselocale(static_cast<locale_t>(m_before));
    ::freelocale(static_cast<locale_t>(m_english));
}

}  // namespace database
