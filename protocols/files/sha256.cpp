#include "protocols/files/sha256.h"

#include <gcrypt.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include "protocols/files/whole_file.h"

namespace protocols {

namespace {

constexpr std::size_t digestBytes = 32;

/// libgcrypt asks to be told once that a program is ready to use it. Hashes need none of its locked memory.
void prepareLibrary()
{
    static const bool isPrepared = [] {
        if (gcry_control(GCRYCTL_INITIALIZATION_FINISHED_P)) return true;
        if (gcry_check_version(nullptr) == nullptr) std::abort();  // the header is of another library
        gcry_control(GCRYCTL_DISABLE_SECMEM, 0);
        gcry_control(GCRYCTL_INITIALIZATION_FINISHED, 0);
        return true;
    }();
    static_cast<void>(isPrepared);
}

std::string inHexadecimal(const unsigned char* digest)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text(2 * digestBytes, '0');
    for (std::size_t i = 0; i < digestBytes; ++i) {
        text[2 * i] = digits[digest[i] >> 4];
        text[2 * i + 1] = digits[digest[i] & 15];
    }
    return text;
}

struct Closing {
    void operator()(gcry_md_hd_t hash) const { gcry_md_close(hash); }
};

}  // namespace

std::string sha256(std::string_view bytes)
{
    prepareLibrary();
    unsigned char digest[digestBytes];
    gcry_md_hash_buffer(GCRY_MD_SHA256, digest, bytes.data(), bytes.size());
    return inHexadecimal(digest);
}

std::string sha256OfFile(const std::filesystem::path& file)
{
    prepareLibrary();
    gcry_md_hd_t opened = nullptr;
    if (gcry_md_open(&opened, GCRY_MD_SHA256, 0) != 0) throw std::bad_alloc();  // the only reason for this algorithm
    const std::unique_ptr<std::remove_pointer_t<gcry_md_hd_t>, Closing> hash(opened);
    readInBlocks(file, [&](std::string_view block) { gcry_md_write(hash.get(), block.data(), block.size()); });
    return inHexadecimal(gcry_md_read(hash.get(), GCRY_MD_SHA256));
}

}  // namespace protocols
