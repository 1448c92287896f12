#include "study/app/state/study_making.h"

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "study/app/language/below.h"

namespace study::app {

StudyMaking::StudyMaking(MakeStudy make, NewStudyRequest request, QObject* parent)
    : QObject(parent), m_make(std::move(make)), m_request(std::move(request))
{
}

void StudyMaking::begin()
{
    m_work.run(
        [this](const std::atomic<bool>& isStopping) -> InBackground::Then {
            const QStringList remarks = make(isStopping);
            return [this, remarks] { Q_EMIT done(remarks); };
        },
        [this](const QString& why) { Q_EMIT failed(why); });
}

QStringList StudyMaking::make(const std::atomic<bool>& isStopping)
{
    const auto remarks = m_make(m_request, [&](double fraction, const std::string& what) {
        if (isStopping)
            throw protocols::workFailed({.what = "creating the study was stopped",
                                         .where = m_request.study.string(),
                                         .expected = {},
                                         .nextStep = "nothing was kept; create the study again when you are ready"});
        Q_EMIT progressed(fraction, inOwnLanguage(what));
    });
    QStringList shown;
    for (const std::string& remark : remarks) shown << inOwnLanguage(protocols::printable(remark));
    return shown;
}

}  // namespace study::app
