// What the window remembers between runs: the studies last used and how it looks. Without settings nothing
// is remembered and nothing fails.
#pragma once

#include <QSettings>
#include <QStringList>

#include "study/app/state/appearance.h"

namespace study::app {

/// The last used first; folders that are gone are left out.
QStringList recentStudies(const QSettings* settings);
void rememberStudy(QSettings* settings, const QString& folder);

/// Where nothing is remembered: the theme of the system and text at 100 percent.
Appearance rememberedAppearance(const QSettings* settings);
void rememberAppearance(QSettings* settings, const Appearance& appearance);

}  // namespace study::app
