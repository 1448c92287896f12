// The file of the window's settings, which another program or a damaged disk may have changed. Qt builds an object of any type,
// of any size, for a value that begins with "@Variant(". This program keeps only texts, lists of texts and numbers.
#pragma once

#include <QByteArray>
#include <QString>
#include <string>

namespace study::app {

/// Largest file of settings that is read, bytes. The window itself keeps less than a hundredth of it.
inline constexpr qint64 largestSettings = 1 << 20;

/// Whether Qt would build an object from some value of this INI text. Also true where no value begins with such a type, but a
/// part of a text after "=" or "," does.
bool namesObjects(const QByteArray& ini);

/// Renames the file to FILE.unreadable where it names objects or is larger than `largestSettings`, over an earlier one of that
/// name. Returns what the user should know, in English; empty where the file stays, or is missing. Throws
/// std::filesystem::filesystem_error where it cannot be renamed: then it must not be read.
std::string setUnreadableAside(const QString& file);

}  // namespace study::app
