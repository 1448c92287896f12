// Settings that the window stores between runs: recent studies and appearance. Without settings nothing is stored and
// nothing fails.
#pragma once

#include <QSettings>
#include <QStringList>

#include "study/app/state/appearance.h"

namespace study::app {

/// Recent study folders that still exist, the latest first.
QStringList recentStudies(const QSettings* settings);
void rememberStudy(QSettings* settings, const QString& folder);

/// The stored appearance; by default the theme of the system and text at 100 %.
Appearance rememberedAppearance(const QSettings* settings);
void rememberAppearance(QSettings* settings, const Appearance& appearance);

}  // namespace study::app
