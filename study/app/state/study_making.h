// Makes a study on a worker thread and reports the progress to the window.
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

#include "study/app/state/app_options.h"
#include "study/app/state/in_background.h"

namespace study::app {

class StudyMaking : public QObject {
    Q_OBJECT
public:
    /// The destructor stops the work and waits for its end.
    StudyMaking(MakeStudy make, NewStudyRequest request, QObject* parent);

    void begin();
    /// The work ends at its next report of progress, and `failed` follows.
    void stop() { m_work.askToStop(); }
    const NewStudyRequest& request() const { return m_request; }

Q_SIGNALS:
    void progressed(double fraction, const QString& what);  ///< emitted on the worker thread
    void done(const QStringList& remarks);
    void failed(const QString& why);

private:
    QStringList make(const std::atomic<bool>& isStopping);

    MakeStudy m_make;
    NewStudyRequest m_request;
    InBackground m_work;
};

}  // namespace study::app
