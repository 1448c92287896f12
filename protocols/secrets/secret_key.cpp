#include "protocols/secrets/secret_key.h"

#include <sodium.h>

#include <cstring>

#include "protocols/files/errors.h"

namespace protocols {

void startSecrets()
{
    if (sodium_init() < 0)
        throw environmentFault({"the random source of the system cannot be used", "", "getrandom(2)", "start the program again"});
}

SecretKey SecretKey::drawn()
{
    startSecrets();
    SecretKey key;
    randombytes_buf(key.m_bytes.data(), size);
    return key;
}

SecretKey SecretKey::ofSeed(std::uint64_t seed)
{
    const std::string text = "seed " + std::to_string(seed);
    SecretKey key;
    crypto_generichash(key.m_bytes.data(), size, reinterpret_cast<const unsigned char*>(text.data()), text.size(), nullptr, 0);
    return key;
}

SecretKey SecretKey::ofHex(std::string_view hex, const std::string& where)
{
    const std::string bytes = ofHexText(hex, where);
    if (bytes.size() != size)
        throw badInput({"the key has " + std::to_string(bytes.size()) + " bytes", where, "64 hexadecimal digits",
                        "restore the file from a backup"});
    SecretKey key;
    std::memcpy(key.m_bytes.data(), bytes.data(), size);
    return key;
}

SecretKey::~SecretKey() { sodium_memzero(m_bytes.data(), size); }

std::string SecretKey::hex() const { return hexText({reinterpret_cast<const char*>(m_bytes.data()), size}); }

SecretKey SecretKey::derived(std::string_view purpose) const
{
    SecretKey key;
    crypto_generichash(key.m_bytes.data(), size, reinterpret_cast<const unsigned char*>(purpose.data()), purpose.size(),
                       m_bytes.data(), size);
    return key;
}

std::uint64_t SecretKey::seedFor(std::string_view purpose) const
{
    const SecretKey key = derived(purpose);
    std::uint64_t seed = 0;
    for (std::size_t byte = 0; byte < sizeof seed; ++byte) seed |= std::uint64_t{key.m_bytes[byte]} << (8 * byte);
    return seed;
}

std::string hexText(std::string_view bytes)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    text.reserve(bytes.size() * 2);
    for (const char byte : bytes) {
        text += digits[static_cast<unsigned char>(byte) >> 4];
        text += digits[static_cast<unsigned char>(byte) & 15];
    }
    return text;
}

std::string ofHexText(std::string_view hex, const std::string& where)
{
    std::string bytes(hex.size() / 2, '\0');
    std::size_t length = 0;
    const char* end = nullptr;
    if (sodium_hex2bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), hex.data(), hex.size(), nullptr, &length,
                       &end) != 0 ||
        end != hex.data() + hex.size() || length != bytes.size() || hex.size() % 2 != 0)
        throw badInput({"the text is not hexadecimal", where, "digits 0-9 and a-f", "restore the file from a backup"});
    return bytes;
}

std::string drawHex(std::size_t bytes)
{
    startSecrets();
    std::string drawn(bytes, '\0');
    randombytes_buf(drawn.data(), drawn.size());
    return hexText(drawn);
}

}  // namespace protocols
