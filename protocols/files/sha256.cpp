#include "protocols/files/sha256.h"

#include <sha2.h>
#include <sys/types.h>

#include <array>
#include <cstdint>

#include "protocols/files/whole_file.h"

namespace protocols {

namespace {

void add(SHA2_CTX& context, std::string_view bytes)
{
    SHA256Update(&context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string inHexadecimal(SHA2_CTX& context)
{
    std::array<std::uint8_t, SHA256_DIGEST_LENGTH> digest{};
    SHA256Final(digest.data(), &context);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * digest.size());
    for (const std::uint8_t byte : digest) {
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

}  // namespace

std::string sha256(std::string_view bytes)
{
    SHA2_CTX context;
    SHA256Init(&context);
    add(context, bytes);
    return inHexadecimal(context);
}

std::string sha256OfFile(const std::filesystem::path& file)
{
    SHA2_CTX context;
    SHA256Init(&context);
    readInBlocks(file, [&](std::string_view block) { add(context, block); });
    return inHexadecimal(context);
}

}  // namespace protocols
