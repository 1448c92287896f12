// Authenticated encryption (XChaCha20-Poly1305 of libsodium). Sealed bytes are random for who lacks the key: they show the
// length of the content and nothing else. Two seals of the same content differ.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocols/secrets/secret_key.h"

namespace protocols {

/// Bytes that a seal adds to its content: the nonce and the authentication tag.
inline constexpr std::size_t sealBytes = 40;

/// `bound`: a text that the seal is bound to, such as the name of its file; open() needs the same.
std::string seal(const SecretKey& key, std::string_view content, std::string_view bound);

/// The content; empty optional where key or bound text are others, or where a bit was changed.
std::optional<std::string> open(const SecretKey& key, std::string_view sealed, std::string_view bound);

/// Work of one guess at a passphrase.
enum class PassphraseCost {
    ForPeople,  ///< Argon2id, 256 MiB and about half a second
    ForTests,   ///< Argon2id with the least work that libsodium takes
};

/// The version of libsodium, such as "1.0.18".
std::string sealingLibraryVersion();

/// A JSON text "vis2hap.sealed/1" that holds the content, sealed with a key that Argon2id derives from the passphrase.
std::string sealWithPassphrase(std::string_view passphrase, std::string_view content,
                               PassphraseCost cost = PassphraseCost::ForPeople);

/// Throws badInput on a text that no passphrase can open: malformed, too short, or with more than 1 GiB or 16 passes of work.
void requireSealedForm(std::string_view sealed, const std::string& where);

/// The content; empty optional where the passphrase is another. `where` names the source in errors. Throws badInput on
/// malformed text, also on more than 1 GiB or 16 passes of work.
std::optional<std::string> openWithPassphrase(std::string_view passphrase, std::string_view sealed, const std::string& where);

}  // namespace protocols
