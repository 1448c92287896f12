#include "study/app/participant/participant_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QScreen>
#include <QVBoxLayout>

#include "study/app/participant/instruction_view.h"

namespace study::app {

ParticipantWindow::ParticipantWindow(const ParticipantSide& side, QScreen& screen, const QScreen& console)
    : QWidget(nullptr, Qt::Window | Qt::WindowDoesNotAcceptFocus)
{
    setObjectName("participantWindow");
    setWindowTitle(tr("For the participant – Vis2Hap"));
    setAttribute(Qt::WA_ShowWithoutActivating);  // the console keeps the keyboard
    setAttribute(Qt::WA_QuitOnClose, false);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(new InstructionView(side, this));
    // Qt moves the window of an unplugged screen to another one, where it would cover the console.
    connect(qApp, &QGuiApplication::screenRemoved, this, [this, own = &screen](const QScreen* removed) {
        if (removed == own) close();
    });
    setScreen(&screen);
    const QRect room = screen.availableGeometry();
    if (&screen == &console) {
        resize(room.size() / 2);
        move(room.topLeft() + QPoint(room.width() / 4, room.height() / 4));
        show();
    } else {
        setGeometry(screen.geometry());
        showFullScreen();
    }
}

void ParticipantWindow::closeEvent(QCloseEvent* event)
{
    QWidget::closeEvent(event);
    // Queued, because the listener destroys this window.
    QMetaObject::invokeMethod(this, &ParticipantWindow::closed, Qt::QueuedConnection);
}

}  // namespace study::app
