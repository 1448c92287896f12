#include "protocols/records/sealed_stimulus.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/sealing.h"

namespace protocols {

namespace {

constexpr std::time_t stimulusTime = 946684800;  // 2000-01-01 00:00:00 UTC

}  // namespace

std::filesystem::path stimulusFile(const std::filesystem::path& stimuli, const FileCode& code)
{
    return stimuli / (code.value + ".sealed");
}

std::string writeSealedStimulus(const std::filesystem::path& stimuli, const FileCode& code, std::string_view pgm,
                                const SecretKey& stationKey)
{
    const auto file = stimulusFile(stimuli, code);
    const std::string bytes = seal(stationKey, pgm, code.value);
    writeWholeFile(file, bytes, Sync::Later, Readers::OwnerOnly);
    // Different times would distinguish stimuli.
    const timespec times[2] = {{stimulusTime, 0}, {stimulusTime, 0}};
    if (utimensat(AT_FDCWD, file.c_str(), times, 0) != 0)
        throw environmentFault({.what = std::string("the time stamp cannot be set (") + std::strerror(errno) + ")",
                                .where = file.string(),
                                .expected = "a folder of this user on a local disk",
                                .nextStep = "choose another folder for the study"});
    return sha256(bytes);
}

}  // namespace protocols
