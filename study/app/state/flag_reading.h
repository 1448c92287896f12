// Reads the flags of a study on a worker thread, because this takes as long as half a report.
#pragma once

#include <QObject>
#include <filesystem>

#include "study/app/state/in_background.h"
#include "study/app/state/monitor.h"

namespace study::app {

class FlagReading : public QObject {
    Q_OBJECT
public:
    /// The destructor waits for a running reading.
    FlagReading(ReadFlags read, std::filesystem::path study, QObject* parent);

    /// Starts a reading; does nothing while one is running.
    void begin();
    bool isUnderWay() const { return m_work.isBusy(); }

Q_SIGNALS:
    void done(const std::vector<study::app::MonitorFlag>& flags);
    void failed(const QString& why);

private:
    ReadFlags m_read;
    std::filesystem::path m_study;
    InBackground m_work;
};

}  // namespace study::app
