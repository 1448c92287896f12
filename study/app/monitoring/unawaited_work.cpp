#include "study/app/monitoring/unawaited_work.h"

#include <exception>
#include <mutex>
#include <system_error>

#include "database/server/server_link.h"
#include "study/app/language/below.h"
#include "study/app/state/in_background.h"

namespace study::app {

/// Where the thread delivers its result.
struct UnawaitedWork::Return {
    std::mutex mutex;
    UnawaitedWork* taker = nullptr;  ///< null when nobody waits any more
};

void UnawaitedWork::run(Work work, Failed failed)
{
    giveUp();
    m_return = std::make_shared<Return>();
    m_return->taker = this;
    const auto onThread = [way = m_return, work = std::move(work), failed] {
        Then then;
        try {
            then = work();
        } catch (const std::exception& fault) {
            then = [failed, why = inOwnLanguage(fault.what())] { failed(why); };
        }
        deliver(way, then);
    };
    try {
        database::runBesideLinks(onThread);
    } catch (const std::system_error&) {
        deliver(m_return, [failed = std::move(failed)] { failed(noThreadText()); });
    }
}

void UnawaitedWork::deliver(const std::shared_ptr<Return>& way, const Then& then)
{
    const std::lock_guard lock(way->mutex);
    if (!way->taker) return;
    QMetaObject::invokeMethod(
        way->taker,
        [way, then] {
            UnawaitedWork* taker = way->taker;
            if (!taker) return;
            taker->giveUp();
            then();
        },
        Qt::QueuedConnection);
}

void UnawaitedWork::giveUp()
{
    if (!m_return) return;
    const std::shared_ptr<Return> given = std::move(m_return);
    m_return.reset();
    const std::lock_guard lock(given->mutex);
    given->taker = nullptr;
}

}  // namespace study::app
