#include "study/app/state/study_making.h"

#include <exception>

#include "protocols/files/errors.h"

namespace study::app {

StudyMaking::StudyMaking(MakeStudy make, NewStudyRequest request, QObject* parent)
    : QObject(parent), m_make(std::move(make)), m_request(std::move(request))
{
}

StudyMaking::~StudyMaking()
{
    stop();
    if (m_thread.joinable()) m_thread.join();
}

void StudyMaking::begin()
{
    m_thread = std::thread([this] { work(); });
}

void StudyMaking::work()
{
    const auto progress = [this](double fraction, const std::string& what) {
        if (m_isStopping)
            throw protocols::workFailed({.what = "the making of the study was stopped",
                                         .where = m_request.study.string(),
                                         .expected = {},
                                         .nextStep = "make it again whenever you like; nothing was kept"});
        Q_EMIT progressed(fraction, QString::fromStdString(what));
    };
    try {
        m_make(m_request, progress);
        Q_EMIT done();
    } catch (const std::exception& fault) {
        Q_EMIT failed(QString::fromUtf8(fault.what()));
    }
}

}  // namespace study::app
