#include "study/app/state/recent_studies.h"

#include <QApplication>
#include <QFileInfo>
#include <algorithm>

namespace study::app {

namespace {

constexpr int mostRecent = 8;
constexpr auto recentKey = "recentStudies";
constexpr auto darkKey = "darkRoom";
constexpr auto contrastKey = "highContrast";
constexpr auto percentKey = "textPercent";

bool systemIsDark() { return QApplication::palette().color(QPalette::Window).lightness() < 128; }

}  // namespace

QStringList recentStudies(const QSettings* settings)
{
    QStringList folders = settings ? settings->value(recentKey).toStringList() : QStringList();
    folders.removeIf([](const QString& folder) {
        return !QFileInfo(folder + QStringLiteral("/study.db")).exists() &&
               !QFileInfo(folder + QStringLiteral("/server.json")).exists();
    });
    return folders;
}

void rememberStudy(QSettings* settings, const QString& folder)
{
    if (!settings) return;
    QStringList folders = settings->value(recentKey).toStringList();
    folders.removeAll(folder);
    folders.prepend(folder);
    settings->setValue(recentKey, folders.mid(0, mostRecent));
}

Appearance rememberedAppearance(const QSettings* settings)
{
    const Theme ofSystem = systemIsDark() ? Theme::DarkRoom : Theme::Light;
    if (!settings) return {ofSystem, 100};
    const bool isDark = settings->value(darkKey, ofSystem == Theme::DarkRoom).toBool();
    if (settings->value(contrastKey, false).toBool())
        return {Theme::HighContrast, std::clamp(settings->value(percentKey, 100).toInt(), 75, 250)};
    return {isDark ? Theme::DarkRoom : Theme::Light, std::clamp(settings->value(percentKey, 100).toInt(), 75, 250)};
}

void rememberAppearance(QSettings* settings, const Appearance& appearance)
{
    if (!settings) return;
    settings->setValue(darkKey, appearance.theme == Theme::DarkRoom);
    settings->setValue(contrastKey, appearance.theme == Theme::HighContrast);
    settings->setValue(percentKey, appearance.textPercent);
}

}  // namespace study::app
