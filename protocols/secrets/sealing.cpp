#include "protocols/secrets/sealing.h"

#include <sodium.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"

namespace protocols {

namespace {

constexpr const char* sealedSchema = "vis2hap.sealed/1";
constexpr std::size_t nonceBytes = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
constexpr std::size_t tagBytes = crypto_aead_xchacha20poly1305_ietf_ABYTES;
static_assert(nonceBytes + tagBytes == sealBytes);
constexpr std::uint64_t mostMemory = std::uint64_t{1} << 30;
constexpr std::uint64_t mostPasses = 16;
/// Passes over 1 GiB take some seconds each. No level of libsodium needs more, and a key that somebody made may not hold up a
/// program for minutes.
constexpr std::uint64_t mostWork = 4 * mostMemory;

const unsigned char* bytesOf(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

struct Derivation {
    std::string salt;
    std::uint64_t passes = 0, memory = 0;
};

SecretKey keyOf(std::string_view passphrase, const Derivation& derivation)
{
    std::string key(SecretKey::size, '\0');
    if (crypto_pwhash(reinterpret_cast<unsigned char*>(key.data()), key.size(), passphrase.data(), passphrase.size(),
                      bytesOf(derivation.salt), derivation.passes, derivation.memory, crypto_pwhash_ALG_ARGON2ID13) != 0)
        throw environmentFault({"there is not enough memory to check the passphrase", "",
                                std::to_string(derivation.memory >> 20) + " MiB", "close other programs"});
    return SecretKey::ofHex(hexText(key), "");
}

std::string textOf(const nlohmann::json& document, const char* name, const std::string& where)
{
    const auto member = document.find(name);
    if (member == document.end() || !member->is_string())
        throw badInput({std::string("\"") + name + "\" is missing", where, "a text", "restore the file from a backup"});
    return member->get<std::string>();
}

std::uint64_t numberIn(const nlohmann::json& document, const char* name, std::uint64_t least, std::uint64_t most,
                       const std::string& where)
{
    const auto member = document.find(name);
    if (member == document.end() || !member->is_number_unsigned() || member->get<std::uint64_t>() < least ||
        member->get<std::uint64_t>() > most)
        throw badInput({std::string("\"") + name + "\" is not usable", where,
                        "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                        "restore the file from a backup"});
    return member->get<std::uint64_t>();
}

/// What a sealed text holds, before anybody opens it.
struct SealedParts {
    Derivation derivation;
    std::string box;
};

SealedParts sealedParts(std::string_view sealed, const std::string& where)
{
    const nlohmann::json document = parseStrictJson(sealed, where);
    if (!document.is_object() || textOf(document, "schema", where) != sealedSchema)
        throw badInput(
            {"not a sealed key", where, std::string("\"schema\": \"") + sealedSchema + "\"", "restore the file from a backup"});
    SealedParts parts;
    parts.derivation.salt = ofHexText(textOf(document, "salt", where), where);
    if (parts.derivation.salt.size() != crypto_pwhash_SALTBYTES)
        throw badInput({"the salt has a wrong length", where, "32 hexadecimal digits", "restore the file from a backup"});
    parts.derivation.passes = numberIn(document, "passes", crypto_pwhash_OPSLIMIT_MIN, mostPasses, where);
    parts.derivation.memory = numberIn(document, "memory_bytes", crypto_pwhash_MEMLIMIT_MIN, mostMemory, where);
    if (parts.derivation.passes * parts.derivation.memory > mostWork)
        throw badInput({"\"passes\" and \"memory_bytes\" ask for too much work", where,
                        "a product of at most " + std::to_string(mostWork), "restore the file from a backup"});
    parts.box = ofHexText(textOf(document, "box", where), where);
    return parts;
}

}  // namespace

std::string seal(const SecretKey& key, std::string_view content, std::string_view bound)
{
    startSecrets();
    std::string sealed(content.size() + sealBytes, '\0');
    auto* bytes = reinterpret_cast<unsigned char*>(sealed.data());
    randombytes_buf(bytes, nonceBytes);
    unsigned long long length = 0;
    crypto_aead_xchacha20poly1305_ietf_encrypt(bytes + nonceBytes, &length, bytesOf(content), content.size(), bytesOf(bound),
                                               bound.size(), nullptr, bytes, key.data());
    return sealed;
}

std::optional<std::string> open(const SecretKey& key, std::string_view sealed, std::string_view bound)
{
    if (sealed.size() < sealBytes) return std::nullopt;
    std::string content(sealed.size() - sealBytes, '\0');
    const unsigned char* bytes = bytesOf(sealed);
    unsigned long long length = 0;
    if (crypto_aead_xchacha20poly1305_ietf_decrypt(reinterpret_cast<unsigned char*>(content.data()), &length, nullptr,
                                                   bytes + nonceBytes, sealed.size() - nonceBytes, bytesOf(bound), bound.size(),
                                                   bytes, key.data()) != 0)
        return std::nullopt;
    return content;
}

std::string sealWithPassphrase(std::string_view passphrase, std::string_view content, PassphraseCost cost)
{
    startSecrets();
    const bool forPeople = cost == PassphraseCost::ForPeople;
    Derivation derivation;
    derivation.salt = ofHexText(drawHex(crypto_pwhash_SALTBYTES), "");
    derivation.passes = forPeople ? crypto_pwhash_OPSLIMIT_MODERATE : crypto_pwhash_OPSLIMIT_MIN;
    derivation.memory = forPeople ? crypto_pwhash_MEMLIMIT_MODERATE : crypto_pwhash_MEMLIMIT_MIN;
    const nlohmann::ordered_json document{{"schema", sealedSchema},
                                          {"derivation", "argon2id"},
                                          {"salt", hexText(derivation.salt)},
                                          {"passes", derivation.passes},
                                          {"memory_bytes", derivation.memory},
                                          {"cipher", "xchacha20-poly1305"},
                                          {"box", hexText(seal(keyOf(passphrase, derivation), content, sealedSchema))}};
    return document.dump(2) + "\n";
}

void requireSealedForm(std::string_view sealed, const std::string& where)
{
    if (sealedParts(sealed, where).box.size() <= sealBytes)
        throw badInput({"the sealed box is too short to hold a key", where, "a whole file", "restore the file from a backup"});
}

std::optional<std::string> openWithPassphrase(std::string_view passphrase, std::string_view sealed, const std::string& where)
{
    startSecrets();
    const SealedParts parts = sealedParts(sealed, where);
    return open(keyOf(passphrase, parts.derivation), parts.box, sealedSchema);
}

std::string sealingLibraryVersion() { return sodium_version_string(); }

}  // namespace protocols
