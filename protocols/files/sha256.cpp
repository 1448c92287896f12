#include "protocols/files/sha256.h"

#include <sha2.h>
#include <sys/types.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

std::string inHexadecimal(SHA2_CTX& context)
{
    std::array<std::uint8_t, SHA256_DIGEST_LENGTH> digest{};
    SHA256Final(digest.data(), &context);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) {
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

Error unreadable(const std::filesystem::path& file)
{
    return badInput({.what = std::string("cannot be read (") + std::strerror(errno) + ")",
                     .where = file.string(),
                     .expected = "a readable file",
                     .nextStep = "check the path and its permissions"});
}

}  // namespace

std::string sha256(std::string_view bytes)
{
    SHA2_CTX context;
    SHA256Init(&context);
    SHA256Update(&context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    return inHexadecimal(context);
}

std::string sha256OfFile(const std::filesystem::path& file)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
    if (!stream) throw unreadable(file);
    SHA2_CTX context;
    SHA256Init(&context);
    std::vector<std::uint8_t> block(std::size_t{1} << 16);
    while (const std::size_t got = std::fread(block.data(), 1, block.size(), stream.get()))
        SHA256Update(&context, block.data(), got);
    if (std::ferror(stream.get()) != 0) throw unreadable(file);
    return inHexadecimal(context);
}

}  // namespace protocols
