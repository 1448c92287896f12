// Reads a study's flags on a thread of its own, because that takes as long as half a report; what it finds comes back
// to the window's thread by one queued signal.
#pragma once

#include <QObject>
#include <filesystem>
#include <thread>

#include "study/app/state/monitor.h"

namespace study::app {

class FlagReading : public QObject {
    Q_OBJECT
public:
    FlagReading(ReadFlags read, std::filesystem::path study, QObject* parent);
    /// Waits for the reading that is under way.
    ~FlagReading() override;

    /// Does nothing while one is under way.
    void begin();
    bool isUnderWay() const { return m_isUnderWay; }

Q_SIGNALS:
    void done(const std::vector<study::app::MonitorFlag>& flags);
    void failed(const QString& why);

private:
    void work();

    ReadFlags m_read;
    std::filesystem::path m_study;
    bool m_isUnderWay = false;
    std::thread m_thread;
};

}  // namespace study::app
