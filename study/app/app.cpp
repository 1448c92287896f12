#include "study/app/app.h"

#include <QApplication>
#include <cstdio>
#include <filesystem>

#include "protocols/files/safe_text.h"
#include "study/app/kept_settings.h"
#include "study/app/language/below.h"
#include "study/app/main_window.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/start_page.h"

namespace study::app {

std::shared_ptr<QSettings> userSettings()
{
    const auto opened = [] {
        return std::make_shared<QSettings>(QSettings::IniFormat, QSettings::UserScope, QStringLiteral("vis2hap"),
                                           QStringLiteral("vis2hap"));
    };
    try {
        const std::string aside = setUnreadableAside(opened()->fileName());
        if (!aside.empty()) std::fprintf(stderr, "warning: %s\n", aside.c_str());
    } catch (const std::filesystem::filesystem_error& fault) {
        std::fprintf(stderr, "warning: the settings of the window can be neither read nor renamed (%s)\n",
                     protocols::printable(fault.what()).c_str());
        return nullptr;
    }
    return opened();
}

namespace {

/// Returns the language that the operator chose, and `exitCode` in any case.
QString showWindow(const AppOptions& options, int& exitCode)
{
    MainWindow window(options);
    window.setWindowState(Qt::WindowMaximized);  // content grows with the window, for eyes that are one or two metres away
    window.show();
    if (options.study) {
        try {
            window.openStudy(*options.study);
        } catch (const std::exception& fault) {
            window.startPage().showFault(inOwnLanguage(fault.what()));
        }
    }
    exitCode = QApplication::exec();
    return window.chosenLanguage();
}

}  // namespace

int runApp(AppOptions options, LanguageInUse& language)
{
    int exitCode = 0;
    for (;;) {
        options.language = language.language();
        const QString chosen = showWindow(options, exitCode);
        if (chosen.isEmpty()) return exitCode;
        options.study.reset();  // the start page is where a language is chosen
        options.languageFault.clear();
        try {
            language.use(chosen);
            rememberLanguage(options.settings.get(), chosen);
        } catch (const std::exception& fault) {
            options.languageFault = inOwnLanguage(fault.what());
        }
    }
}

int runMonitor(const AppOptions& options)
{
    MonitorWindow window(options.study.value(), options);
    window.show();
    return QApplication::exec();
}

}  // namespace study::app
