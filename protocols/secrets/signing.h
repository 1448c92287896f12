// Signatures that anyone can check with the public key (Ed25519 of libsodium). The public key is written as PEM, which OpenSSL
// and other programs read, too.
#pragma once

#include <string>
#include <string_view>

#include "protocols/secrets/secret_key.h"

namespace protocols {

/// The public key of the signing key `seed`, 64 hexadecimal digits.
std::string publicKeyOf(const SecretKey& seed);

/// The signature of the bytes, 128 hexadecimal digits.
std::string signatureOf(const SecretKey& seed, std::string_view bytes);

/// False where a bit of bytes, signature or key is another, or where key or signature are not hexadecimal of the right length.
bool isSignedBy(std::string_view publicKey, std::string_view bytes, std::string_view signature);

/// "-----BEGIN PUBLIC KEY-----" ... (RFC 8410) and back. Reading throws badInput for anything but a public key of Ed25519;
/// `where` names the source.
std::string pemOf(std::string_view publicKey);
std::string publicKeyOfPem(std::string_view pem, const std::string& where);

}  // namespace protocols
