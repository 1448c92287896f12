// Runs the making of a study on a thread of its own, so that the window stays alive; what it tells comes back
// to the window's thread, one queued signal each.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <thread>

#include "study/app/state/app_options.h"

namespace study::app {

class StudyMaking : public QObject {
    Q_OBJECT
public:
    StudyMaking(MakeStudy make, NewStudyRequest request, QObject* parent);
    /// Asks the work to stop and waits for it.
    ~StudyMaking() override;

    void begin();
    /// The work stops where it next tells its progress.
    void stop() { m_isStopping = true; }
    const NewStudyRequest& request() const { return m_request; }

Q_SIGNALS:
    void progressed(double fraction, const QString& what);
    void done();
    void failed(const QString& why);

private:
    void work();

    MakeStudy m_make;
    NewStudyRequest m_request;
    std::atomic<bool> m_isStopping = false;
    std::thread m_thread;
};

}  // namespace study::app
