#include "study/app/state/scanner_entry.h"

#include <Qt>
#include <utility>

namespace study::app {

bool ScannerEntry::endsWith(int key, bool isCharacter, std::uint64_t atMs)
{
    const std::uint64_t before = std::exchange(m_lastMs, atMs);
    const bool isQuick = atMs != 0 && before != 0 && atMs >= before && atMs - before <= longestGapMs;
    const bool isEnd = key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Tab;
    if (isEnd) return std::exchange(m_characters, 0) >= fewestCharacters && isQuick;
    if (isCharacter) m_characters = isQuick ? m_characters + 1 : 1;
    return false;
}

}  // namespace study::app
