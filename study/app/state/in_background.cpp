#include "study/app/state/in_background.h"

#include <exception>

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

void InBackground::run(Work work, Failed failed)
{
    stop();
    m_isStopping = false;
    m_isBusy = true;
    m_thread = std::thread([this, run = m_run, work = std::move(work), failed = std::move(failed)] {
        const Then then = outcomeOf(work, m_isStopping, failed);
        QMetaObject::invokeMethod(
            this,
            [this, run, then] {
                if (run != m_run) return;
                m_isBusy = false;
                then();
            },
            Qt::QueuedConnection);
    });
}

void InBackground::stop()
{
    ++m_run;
    m_isStopping = true;
    if (m_thread.joinable()) m_thread.join();
    m_isBusy = false;
}

}  // namespace study::app
