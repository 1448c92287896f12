#include "database/server/server_link.h"

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <queue>
#include <system_error>
#include <thread>

#include "database/server/server_connection.h"
#include "database/server/server_replies.h"
#include "database/sqlite_connection.h"

namespace database {

/// Shared by the link and its thread: whoever ends last frees it.
struct ServerLink::Worker {
    std::mutex mutex;
    std::condition_variable changed;
    std::queue<std::function<void(std::optional<ServerConnection>&, Worker&)>> work;
    bool isEnded = false;

    bool isGivenUp()
    {
        const std::lock_guard lock(mutex);
        return isEnded;
    }

    static void run(const std::shared_ptr<Worker>& own)
    {
        std::optional<ServerConnection> connection;  // belongs to this thread
        std::unique_lock lock(own->mutex);
        while (true) {
            own->changed.wait(lock, [&] { return own->isEnded || !own->work.empty(); });
            if (own->work.empty()) return;
            const auto next = std::move(own->work.front());
            own->work.pop();
            lock.unlock();
            next(connection, *own);
            lock.lock();
        }
    }
};

namespace {

/// Threads of all links of the process, and those beside them: they outlive their owners, so nobody else can count them.
struct LivingThreads {
    std::mutex mutex;
    std::condition_variable ended;
    int count = 0;
};

LivingThreads& livingThreads()
{
    static auto* threads = new LivingThreads;  // a thread may end after the statics of the program
    return *threads;
}

void beginThread()
{
    const std::lock_guard lock(livingThreads().mutex);
    ++livingThreads().count;
}

void endThread()
{
    const std::lock_guard lock(livingThreads().mutex);
    --livingThreads().count;
    livingThreads().ended.notify_all();
}

ServerReply replyOf(const ServerConnection& server, const char* function, const QVariantList& arguments, bool hasImage)
{
    if (!hasImage) return {server.call(function, arguments), {}, {}};
    QStringList places;
    for (qsizetype i = 0; i < arguments.size(); ++i) places << QStringLiteral("?");
    QSqlQuery row = server.run(
        QStringLiteral("SELECT * FROM @schema@.%1(%2)").arg(QLatin1String(function), places.join(QStringLiteral(", "))),
        arguments);
    if (!row.next()) return {};
    const std::string first = fromQt(row.value(0));
    return {first.starts_with('{') ? replyFrom(first, server.address().text) : nlohmann::json(first),
            row.value(1).toByteArray().toStdString(), fromQt(row.value(2))};
}

}  // namespace

ServerLink::ServerLink(ServerAddress address) : m_worker(std::make_shared<Worker>()), m_address(std::move(address))
{
    try {
        runBesideLinks([own = m_worker] { Worker::run(own); });
    } catch (const std::system_error&) {
        throw ServerAway({"the computer starts no further work", "", "memory and room for one more thread",
                          "close other programs, then try again"});
    }
}

ServerLink::~ServerLink()
{
    {
        const std::lock_guard lock(m_worker->mutex);
        m_worker->isEnded = true;
    }
    m_worker->changed.notify_all();
}

ServerReply ServerLink::call(const char* function, const QVariantList& arguments, std::chrono::milliseconds patience)
{
    return waited(ask(function, arguments, false), patience);
}

ServerReply ServerLink::callForImage(const char* function, const QVariantList& arguments, std::chrono::milliseconds patience)
{
    return waited(ask(function, arguments, true), patience);
}

std::future<ServerReply> ServerLink::start(const char* function, const QVariantList& arguments)
{
    return ask(function, arguments, false);
}

std::future<ServerReply> ServerLink::ask(const char* function, const QVariantList& arguments, bool hasImage)
{
    const auto promise = std::make_shared<std::promise<ServerReply>>();
    std::future<ServerReply> reply = promise->get_future();
    {
        const std::lock_guard lock(m_worker->mutex);
        m_worker->work.emplace([=, address = m_address](std::optional<ServerConnection>& connection, Worker& worker) {
            try {
                if (!connection) {
                    connection.emplace(address);
                    if (address.study.empty()) connection->chooseStudy();
                }
                // A call that comes late could take the place of a newer connection.
                if (worker.isGivenUp())
                    throw ServerAway({"the call was given up", address.text, "", "check the network and the server"});
                promise->set_value(replyOf(*connection, function, arguments, hasImage));
            } catch (...) {
                promise->set_exception(std::current_exception());
            }
        });
    }
    m_worker->changed.notify_all();
    return reply;
}

ServerReply ServerLink::waited(std::future<ServerReply> reply, std::chrono::milliseconds patience) const
{
    if (reply.wait_for(patience) != std::future_status::ready)
        throw ServerAway({"the server does not answer", m_address.text, "", "check the network and the server"});
    return reply.get();
}

void runBesideLinks(std::function<void()> work)
{
    beginThread();
    try {
        std::thread([own = std::move(work)]() mutable {
            own();
            own = nullptr;  // what the work holds ends before its thread counts as ended
            endThread();
        }).detach();
    } catch (...) {
        endThread();
        throw;
    }
}

bool haveLinksEnded(std::chrono::milliseconds patience)
{
    LivingThreads& threads = livingThreads();
    std::unique_lock lock(threads.mutex);
    return threads.ended.wait_for(lock, patience, [&] { return threads.count == 0; });
}

}  // namespace database
