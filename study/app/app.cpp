#include "study/app/app.h"

#include <QApplication>

#include "study/app/main_window.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/start_page.h"

namespace study::app {

std::shared_ptr<QSettings> userSettings()
{
    return std::make_shared<QSettings>(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("vis2hap"),
                                       QStringLiteral("vis2hap"));
}

int runApp(const AppOptions& options)
{
    MainWindow window(options);
    window.setWindowState(Qt::WindowMaximized);  // content grows with the window, for eyes that are one or two metres away
    window.show();
    if (options.study) {
        try {
            window.openStudy(*options.study);
        } catch (const std::exception& fault) {
            window.startPage().showFault(QString::fromUtf8(fault.what()));
        }
    }
    return QApplication::exec();
}

int runMonitor(const AppOptions& options)
{
    MonitorWindow window(options.study.value(), options);
    window.show();
    return QApplication::exec();
}

}  // namespace study::app
