// Calls of a server's functions on a thread of their own, so that a cut network or a server that hangs stops nobody for long. A
// call that is not answered in time is given up: its thread ends by itself, and what it sent may have arrived.
#pragma once

#include <QVariant>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "database/server/server_address.h"

namespace database {

/// One answer of a server: the JSON (or a text), and an image where the function gives one out.
struct ServerReply {
    nlohmann::json json;
    std::string image, key;
};

class ServerLink {
public:
    /// Connects at the first call. An address without a study means the only one of its database. Throws ServerAway where no
    /// thread can begin.
    explicit ServerLink(ServerAddress address);
    /// Does not wait for a call that was given up.
    ~ServerLink();
    ServerLink(const ServerLink&) = delete;
    ServerLink& operator=(const ServerLink&) = delete;

    /// Throws what ServerConnection throws, and ServerAway after `patience`. After ServerAway the link is of no more use.
    ServerReply call(const char* function, const QVariantList& arguments, std::chrono::milliseconds patience);
    /// As call(), for functions that return a row of JSON or a text, image and key.
    ServerReply callForImage(const char* function, const QVariantList& arguments, std::chrono::milliseconds patience);

    /// Begins a call whose reply, or fault, is fetched later.
    std::future<ServerReply> start(const char* function, const QVariantList& arguments);

private:
    struct Worker;
    std::future<ServerReply> ask(const char* function, const QVariantList& arguments, bool hasImage);
    ServerReply waited(std::future<ServerReply> reply, std::chrono::milliseconds patience) const;
    std::shared_ptr<Worker> m_worker;
    ServerAddress m_address;
};

/// Runs work that may wait for a server on a thread that nobody waits for but haveLinksEnded(). The work must not throw. Throws
/// std::system_error where no thread can begin.
void runBesideLinks(std::function<void()> work);

/// Waits until the threads of links that were given up, and those of runBesideLinks(), have ended. Returns whether all have. The
/// program must not take down Qt while one of them still waits for a server.
bool haveLinksEnded(std::chrono::milliseconds patience);

}  // namespace database
