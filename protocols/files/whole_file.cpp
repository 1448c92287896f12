#include "protocols/files/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "protocols/files/errors.h"

namespace rendering {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

protocols::Error cannotRead(const std::filesystem::path& file, const std::string& why)
{
    return protocols::badInput({"cannot be read (" + why + ")", file.string(), "a readable file", "check the path"});
}

protocols::Error cannotWrite(const std::filesystem::path& file, int error)
{
    return protocols::environmentFault({std::string("cannot be written (") + std::strerror(error) + ")", file.string(),
                                        "a writable folder with free space", "free space or choose another folder"});
}

}  // namespace

std::string readWholeFile(const std::filesystem::path& file)
{
    std::error_code problem;
    if (std::filesystem::is_directory(file, problem)) throw cannotRead(file, "it is a folder");
    const OpenFile open(std::fopen(file.c_str(), "rb"));
    if (!open) throw cannotRead(file, std::strerror(errno));
    std::string bytes;
    const auto size = std::filesystem::file_size(file, problem);
    if (!problem) bytes.reserve(size);
    char block[65536];
    while (const std::size_t count = std::fread(block, 1, sizeof block, open.get())) bytes.append(block, count);
    if (std::ferror(open.get())) throw cannotRead(file, std::strerror(errno));
    return bytes;
}

void writeWholeFile(const std::filesystem::path& file, std::string_view bytes)
{
    std::filesystem::path temporary = file;
    temporary.replace_filename("." + file.filename().string() + ".part");
    OpenFile open(std::fopen(temporary.c_str(), "wb"));
    if (!open) throw cannotWrite(file, errno);
    bool good = std::fwrite(bytes.data(), 1, bytes.size(), open.get()) == bytes.size();
    int error = errno;
    if (std::fclose(open.release()) != 0) {
        good = false;
        error = errno;
    }
    if (good && std::rename(temporary.c_str(), file.c_str()) == 0) return;
    if (good) error = errno;
    std::remove(temporary.c_str());
    throw cannotWrite(file, error);
}

}  // namespace rendering
