#include "study/app/state/flag_reading.h"

#include <exception>

namespace study::app {

FlagReading::FlagReading(ReadFlags read, std::filesystem::path study, QObject* parent)
    : QObject(parent), m_read(std::move(read)), m_study(std::move(study))
{
}

FlagReading::~FlagReading()
{
    if (m_thread.joinable()) m_thread.join();
}

void FlagReading::begin()
{
    if (m_isUnderWay || !m_read) return;
    if (m_thread.joinable()) m_thread.join();
    m_isUnderWay = true;
    m_thread = std::thread([this] { work(); });
}

void FlagReading::work()
{
    const auto bring = [this](auto signal) {
        QMetaObject::invokeMethod(
            this,
            [this, signal] {
                m_isUnderWay = false;
                signal();
            },
            Qt::QueuedConnection);
    };
    try {
        const database::StudyStore store(database::StudyFolder{m_study}, database::StudyStore::Access::Read);
        bring([this, flags = m_read(store)] { Q_EMIT done(flags); });
    } catch (const std::exception& fault) {
        bring([this, why = QString::fromUtf8(fault.what())] { Q_EMIT failed(why); });
    }
}

}  // namespace study::app
