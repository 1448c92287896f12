// Fonts for the languages of the window and of the participants. Without a font Qt draws empty boxes.
#pragma once

#include <QString>

namespace study::app {

/// The Debian package of a font that can write this language (BCP 47 tag or name of a locale) and that this computer lacks;
/// empty if it has a font. Needs a QGuiApplication.
QString missingFontPackage(const QString& language);

/// Throws environmentFault that names the package of the missing font.
void requireFontFor(const QString& language);

/// The language's own name, "Deutsch"; its English name where no font can write it.
QString nameInList(const QString& language);

}  // namespace study::app
