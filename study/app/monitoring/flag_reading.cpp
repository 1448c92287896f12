#include "study/app/monitoring/flag_reading.h"

namespace study::app {

void FlagReading::begin(const Open& open)
{
    if (isUnderWay() || !m_read) return;
    m_work.run(
        [this, open](const std::atomic<bool>&) -> InBackground::Then {
            const database::StudyStore store = open();
            return [this, flags = m_read(store)] { Q_EMIT done(flags); };
        },
        [this](const QString& why) { Q_EMIT failed(why); });
}

}  // namespace study::app
