// Recognises what a barcode scanner types, by the times between keys: a scanner writes a code and ends it with Enter or Tab
// faster than any hand. Such an Enter must not store an answer.
#pragma once

#include <cstdint>

namespace study::app {

class ScannerEntry {
public:
    /// No hand presses three keys with gaps as short as this, ms.
    static constexpr std::uint64_t longestGapMs = 30;
    static constexpr int fewestCharacters = 2;

    /// Takes the next key. `atMs`: its time by the window system; 0 for a key that no device sent. True for Enter or Tab at the
    /// end of an entry of a scanner.
    bool endsWith(int key, bool isCharacter, std::uint64_t atMs);

private:
    std::uint64_t m_lastMs = 0;
    int m_characters = 0;  ///< in quick succession
};

}  // namespace study::app
