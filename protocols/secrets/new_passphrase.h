// What a new passphrase must be. Passphrases of studies that exist are not checked by it: they open as they are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace protocols {

/// Fewest characters of a new passphrase.
inline constexpr std::size_t shortestPassphrase = 8;

enum class PassphraseFault {
    OnlyBlanks,
    ControlCharacter,  ///< nobody can type it again
    TooShort,          ///< fewer than shortestPassphrase characters (code points)
};

/// Why a text in UTF-8 cannot be a new passphrase; none where it can.
std::optional<PassphraseFault> faultOfNewPassphrase(std::string_view text);

/// The text without the one end of a line that a copied line has.
std::string withoutLineEnd(std::string text);

}  // namespace protocols
