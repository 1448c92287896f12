#include "study/app/pages/photographs/step_work.h"

#include <QPointer>
#include <QWidget>
#include <stdexcept>

#include "study/app/language/below.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

StepStopped::StepStopped() : std::runtime_error(StepWork::tr("Stopped. Nothing was written.").toStdString()) {}

void StepWork::run(MessageBar& message, const QString& doing, Step step)
{
    if (m_work.isBusy()) return;
    const QPointer<QWidget> from = m_page.focusWidget();  // a step takes minutes, and the page may replace its controls
    m_work.run(
        [this, &message, step = std::move(step)](const std::atomic<bool>& isStopping) -> InBackground::Then {
            const auto progress = [this, &message, &isStopping](double fraction, const std::string& what) {
                if (isStopping) throw StepStopped();
                const QString text = tr("%1: %2 %. Esc stops it.").arg(inOwnLanguage(what)).arg(static_cast<int>(100 * fraction));
                QMetaObject::invokeMethod(
                    this,
                    [this, &message, text] {
                        if (m_work.isBusy()) message.showDone(text);
                    },
                    Qt::QueuedConnection);
            };
            const auto then = step(progress);
            return [this, then] {
                Q_EMIT busyChanged();
                then();
            };
        },
        [this, &message, from](const QString& why) {
            Q_EMIT busyChanged();
            if (from) from->setFocus();
            if (why == QString::fromUtf8(StepStopped().what()))
                message.showHint(why);
            else
                message.showFault(why);
        });
    m_page.setFocus();  // The page keeps its place. A disabled control would pass the focus on, and the page would scroll there.
    message.showDone(doing);
    Q_EMIT busyChanged();
}

}  // namespace study::app
