// Reads the flags of a study on a worker thread, because this takes as long as half a report.
#pragma once

#include <QObject>
#include <functional>

#include "study/app/state/in_background.h"
#include "study/app/state/monitor.h"

namespace study::app {

class FlagReading : public QObject {
    Q_OBJECT
public:
    /// Opens the study on the worker thread. Throws the errors of database::StudyStore.
    using Open = std::function<database::StudyStore()>;

    /// The destructor waits for a running reading.
    FlagReading(ReadFlags read, QObject* parent) : QObject(parent), m_read(std::move(read)) {}

    /// Starts a reading; does nothing while one is running.
    void begin(const Open& open);
    bool isUnderWay() const { return m_work.isBusy(); }

Q_SIGNALS:
    void done(const std::vector<study::app::MonitorFlag>& flags);
    void failed(const QString& why);

private:
    ReadFlags m_read;
    InBackground m_work;
};

}  // namespace study::app
