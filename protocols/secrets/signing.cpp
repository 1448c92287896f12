#include "protocols/secrets/signing.h"

#include <sodium.h>

#include <array>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

constexpr std::size_t publicBytes = crypto_sign_PUBLICKEYBYTES, signatureBytes = crypto_sign_BYTES;
static_assert(crypto_sign_SEEDBYTES == SecretKey::size);

constexpr std::string_view pemBegin = "-----BEGIN PUBLIC KEY-----", pemEnd = "-----END PUBLIC KEY-----";
/// The twelve bytes that say "public key of Ed25519" before the key itself, in base 64 (RFC 8410, section 10.1).
constexpr std::string_view pemPrefix = "MCowBQYDK2VwAyEA";

const unsigned char* bytesIn(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

/// The two keys of a seed; the secret one is overwritten at the end.
struct KeyPair {
    std::array<unsigned char, publicBytes> open{};
    std::array<unsigned char, crypto_sign_SECRETKEYBYTES> secret{};

    explicit KeyPair(const SecretKey& seed)
    {
        startSecrets();
        crypto_sign_seed_keypair(open.data(), secret.data(), seed.data());
    }
    ~KeyPair() { sodium_memzero(secret.data(), secret.size()); }
    KeyPair(const KeyPair&) = delete;
    KeyPair& operator=(const KeyPair&) = delete;
};

/// The bytes of hexadecimal text of this length; empty for any other text.
std::string bytesOfHex(std::string_view hex, std::size_t bytes)
{
    if (hex.size() != bytes * 2) return {};
    try {
        return ofHexText(hex, "");
    } catch (const Error&) {
        return {};
    }
}

std::string keyWithoutBlanks(std::string_view text)
{
    std::string rest;
    for (const char c : text)
        if (c != ' ' && c != '\n' && c != '\r' && c != '\t') rest += c;
    return rest;
}

}  // namespace

std::string publicKeyOf(const SecretKey& seed)
{
    const KeyPair pair(seed);
    return hexText({reinterpret_cast<const char*>(pair.open.data()), pair.open.size()});
}

std::string signatureOf(const SecretKey& seed, std::string_view bytes)
{
    const KeyPair pair(seed);
    std::array<unsigned char, signatureBytes> signature{};
    crypto_sign_detached(signature.data(), nullptr, bytesIn(bytes), bytes.size(), pair.secret.data());
    return hexText({reinterpret_cast<const char*>(signature.data()), signature.size()});
}

bool isSignedBy(std::string_view publicKey, std::string_view bytes, std::string_view signature)
{
    startSecrets();
    const std::string key = bytesOfHex(publicKey, publicBytes), mark = bytesOfHex(signature, signatureBytes);
    return !key.empty() && !mark.empty() &&
           crypto_sign_verify_detached(bytesIn(mark), bytesIn(bytes), bytes.size(), bytesIn(key)) == 0;
}

std::string pemOf(std::string_view publicKey)
{
    const std::string key = ofHexText(publicKey, "the public key");
    std::array<char, 64> base64{};
    sodium_bin2base64(base64.data(), base64.size(), bytesIn(key), key.size(), sodium_base64_VARIANT_ORIGINAL);
    return std::string(pemBegin) + "\n" + std::string(pemPrefix) + base64.data() + "\n" + std::string(pemEnd) + "\n";
}

std::string publicKeyOfPem(std::string_view pem, const std::string& where)
{
    const auto begin = pem.find(pemBegin), end = pem.find(pemEnd);
    std::string body;
    if (begin != std::string_view::npos && end != std::string_view::npos && begin < end)
        body = keyWithoutBlanks(pem.substr(begin + pemBegin.size(), end - begin - pemBegin.size()));
    std::array<unsigned char, publicBytes> key{};
    std::size_t length = 0;
    const bool isKey = body.starts_with(pemPrefix) &&
                       sodium_base642bin(key.data(), key.size(), body.data() + pemPrefix.size(), body.size() - pemPrefix.size(),
                                         nullptr, &length, nullptr, sodium_base64_VARIANT_ORIGINAL) == 0 &&
                       length == key.size();
    if (!isKey)
        throw badInput({"this is no public key of Ed25519", where, std::string(pemBegin) + " and 60 characters of base 64",
                        "name the file that `vis2hap study signing-key` wrote beside the key (FILE.pub)"});
    return hexText({reinterpret_cast<const char*>(key.data()), key.size()});
}

}  // namespace protocols
