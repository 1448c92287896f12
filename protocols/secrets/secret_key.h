// A secret of 32 bytes, from which keys and seeds for named purposes are derived (BLAKE2b of libsodium). One derived value tells
// nothing about the secret or about another derived value.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace protocols {

/// Its memory is overwritten when it ends.
class SecretKey {
public:
    static constexpr std::size_t size = 32;

    /// All bytes zero: no secret yet.
    SecretKey() = default;
    /// From the random source of the system.
    static SecretKey drawn();
    /// The same secret for the same seed: for tests only, since a seed of 64 bits can be guessed.
    static SecretKey ofSeed(std::uint64_t seed);
    /// Of 64 hexadecimal digits. `where` names the source in errors. Throws badInput.
    static SecretKey ofHex(std::string_view hex, const std::string& where);

    SecretKey(const SecretKey&) = default;
    SecretKey& operator=(const SecretKey&) = default;
    ~SecretKey();

    std::string hex() const;
    const unsigned char* data() const { return m_bytes.data(); }

    SecretKey derived(std::string_view purpose) const;
    std::uint64_t seedFor(std::string_view purpose) const;

private:
    std::array<unsigned char, size> m_bytes{};
};

/// Starts libsodium once. Throws environmentFault where the system has no random source.
void startSecrets();

/// Bytes from the random source of the system, in lower-case hexadecimal.
std::string drawHex(std::size_t bytes);

/// Hexadecimal text of bytes, and back. ofHexText() throws badInput for text that is not hexadecimal.
std::string hexText(std::string_view bytes);
std::string ofHexText(std::string_view hex, const std::string& where);

}  // namespace protocols
