// Reads a study's flags in the background, because that takes as long as half a report.
#pragma once

#include <QObject>
#include <filesystem>

#include "study/app/state/in_background.h"
#include "study/app/state/monitor.h"

namespace study::app {

class FlagReading : public QObject {
    Q_OBJECT
public:
    /// Its end waits for a reading that is under way.
    FlagReading(ReadFlags read, std::filesystem::path study, QObject* parent);

    /// Does nothing while a reading is under way.
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
