#include "study/app/state/in_background.h"

namespace study::app {

void InBackground::run(Work work)
{
    stop();
    m_isStopping = false;
    m_isBusy = true;
    m_thread = std::thread([this, run = m_run, work = std::move(work)] {
        const Then then = work(m_isStopping);
        QMetaObject::invokeMethod(
            this,
            [this, run, then] {
                if (run != m_run) return;  // stopped since
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
