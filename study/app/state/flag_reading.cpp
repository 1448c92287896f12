#include "study/app/state/flag_reading.h"

#include "database/server/study_move.h"

namespace study::app {

FlagReading::FlagReading(ReadFlags read, std::filesystem::path study, QObject* parent)
    : QObject(parent), m_read(std::move(read)), m_study(std::move(study))
{
}

void FlagReading::begin()
{
    if (isUnderWay() || !m_read) return;
    m_work.run(
        [this](const std::atomic<bool>&) -> InBackground::Then {
            const database::StudyStore store = database::readStudy({m_study});
            return [this, flags = m_read(store)] { Q_EMIT done(flags); };
        },
        [this](const QString& why) { Q_EMIT failed(why); });
}

}  // namespace study::app
