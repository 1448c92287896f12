#include "study/app/state/in_background.h"

#include <exception>
#include <system_error>

#include "protocols/files/errors.h"
#include "study/app/language/below.h"

namespace study::app {

namespace {

InBackground::Then outcomeOf(const InBackground::Work& work, const std::atomic<bool>& isStopping,
                             const InBackground::Failed& failed)
{
    try {
        return work(isStopping);
    } catch (const std::exception& fault) {
        return [failed, why = inOwnLanguage(fault.what())] { failed(why); };
    }
}

}  // namespace

QString noThreadText()
{
    const protocols::Error fault =
        protocols::environmentFault({"the computer starts no further work", "", "memory and room for one more thread",
                                     "close other programs, then try again"});
    return inOwnLanguage(fault.what());
}

void InBackground::run(Work work, Failed failed)
{
    stop();
    m_isStopping = false;
    try {
        m_thread = std::thread(
            [this, run = m_run, work = std::move(work), failed] { deliver(run, outcomeOf(work, m_isStopping, failed)); });
        m_isBusy = true;
    } catch (const std::system_error&) {
        // Later, as every other fault: the caller may still show that the work goes on.
        deliver(m_run, [failed = std::move(failed)] { failed(noThreadText()); });
    }
}

void InBackground::deliver(int run, const Then& then)
{
    QMetaObject::invokeMethod(
        this,
        [this, run, then] {
            if (run != m_run) return;
            m_isBusy = false;
            then();
        },
        Qt::QueuedConnection);
}

void InBackground::stop()
{
    ++m_run;
    m_isStopping = true;
    if (m_thread.joinable()) m_thread.join();
    m_isBusy = false;
}

}  // namespace study::app
