#include "study/making/own/program_images.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_io.h"
#include "rendering/models/process/limited_process.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;
using rendering::models::LimitedProcess;
using rendering::models::ProcessLimits;
using rendering::models::ProcessSurroundings;

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
constexpr std::uint64_t largestFileMib = 64;
constexpr std::size_t longestLine = 200;  ///< bytes of an error line that are shown

/// One call of a program.
struct ProgramCall {
    const OwnProgram& own;
    fs::path photograph;  ///< in the data set, for messages
    std::string fabric;   ///< "fabric F03 (3 of 7)"
    ProgramLimits limits;

    /// What went wrong; empty texts are the usual ones.
    protocols::Error failure(const std::string& what, const std::string& expected = {}, const std::string& next = {}) const
    {
        const std::string usual = "status 0 and an image in the file that the last argument names";
        const std::string byHand = "try `" + own.command + " " + photograph.string() + " image.png`";
        return protocols::workFailed({fabric + ": the program of condition '" + own.condition.value + "' " + what, own.command,
                                      expected.empty() ? usual : expected, next.empty() ? byHand : next});
    }
};

/// The files of a call, in a folder that vanishes.
struct CallFolder {
    protocols::TemporaryFolder temporary;
    fs::path photograph = temporary.path() / "photograph.png";
    fs::path plainPhotograph = temporary.path() / "photograph.ppm";
    fs::path image = temporary.path() / "image.png";
    fs::path output = temporary.path() / "output";
    fs::path errors = temporary.path() / "errors";
};

/// Binary PPM, for programs without a library that reads PNG.
std::string ppmBytes(const cv::Mat& rgb)
{
    std::string bytes = "P6\n" + std::to_string(rgb.cols) + " " + std::to_string(rgb.rows) + "\n255\n";
    for (int y = 0; y < rgb.rows; ++y) bytes.append(rgb.ptr<char>(y), static_cast<std::size_t>(rgb.cols) * 3);
    return bytes;
}

/// No variable of this process but the search path and the home folder: a passphrase may stand in the others.
std::vector<std::string> environmentIn(const fs::path& folder, std::optional<double> mmPerPixel)
{
    std::vector<std::string> variables{"LANG=C.UTF-8", "TMPDIR=" + folder.string()};
    for (const char* name : {"PATH", "HOME"})
        if (const char* value = std::getenv(name)) variables.push_back(std::string(name) + "=" + value);
    if (mmPerPixel) variables.push_back("VIS2HAP_MM_PER_PIXEL=" + protocols::shortest(*mmPerPixel));
    return variables;
}

/// At most `longestLine` bytes, without control characters.
std::string lastLineIn(const fs::path& file)
{
    const std::string text = protocols::readRegularFile(file, largestFileMib * mebibyte);
    const std::size_t end = text.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return {};
    const std::size_t before = text.find_last_of('\n', end);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    std::string_view rest = std::string_view(text).substr(begin, end + 1 - begin);
    std::string line;
    while (!rest.empty() && line.size() < longestLine) {
        const std::size_t length = protocols::utf8Length(rest);
        if (length == 0)
            line += '?';
        else
            line += rest.substr(0, length);
        rest.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return protocols::printable(line);
}

bool reachedLimit(const fs::path& file)
{
    std::error_code none;
    const auto size = fs::file_size(file, none);
    return !none && size >= largestFileMib * mebibyte;
}

int statusOf(const ProgramCall& call, const CallFolder& folder, std::optional<double> mmPerPixel)
{
    std::vector<std::string> arguments = call.own.arguments;
    arguments.push_back(folder.photograph.string());
    arguments.push_back(folder.image.string());
    ProcessLimits limits;
    limits.time = call.limits.time;
    limits.memoryBytes = static_cast<std::uint64_t>(call.limits.memoryMib) * mebibyte;
    limits.fileBytes = largestFileMib * mebibyte;
    ProcessSurroundings surroundings{.environment = environmentIn(folder.temporary.path(), mmPerPixel),
                                     .output = folder.output,
                                     .errors = folder.errors,
                                     .withDescendants = true};
    surroundings.ifItCannotStart = "begin a script with #! and its interpreter, or put it in front, such as python3";
    std::optional<LimitedProcess> process;
    try {
        process.emplace(call.own.program, arguments, surroundings, limits);
    } catch (const protocols::Error& fault) {
        throw protocols::badInput({fault.what(), "", "", ""});  // The call named it, so the call is wrong.
    }
    const std::optional<int> status = process->statusInTime();
    if (!status)
        throw call.failure("did not end within " + std::to_string(call.limits.time.count()) + " s and was stopped", {},
                           "make it faster, or allow more with --program-seconds");
    return *status;
}

cv::Mat decoded(const ProgramCall& call, const fs::path& file)
{
    const std::string bytes = protocols::readRegularFile(file, largestFileMib * mebibyte);
    const bool isPgm = bytes.starts_with("P5");
    if (!isPgm && !bytes.starts_with("\x89PNG")) throw call.failure("wrote a file that is neither PNG nor binary PGM");
    try {
        return isPgm ? rendering::pgmOfBytes(bytes, file) : rendering::readPng(file);
    } catch (const protocols::Error&) {
        throw call.failure(std::string("wrote a damaged ") + (isPgm ? "PGM" : "PNG"));
    }
}

cv::Mat imageFrom(const ProgramCall& call, const cv::Mat& photograph, std::optional<double> mmPerPixel)
{
    const CallFolder folder;
    rendering::writePng(folder.photograph, photograph, protocols::Sync::Later);
    protocols::writeWholeFile(folder.plainPhotograph, ppmBytes(photograph), protocols::Sync::Later);
    const int status = statusOf(call, folder, mmPerPixel);
    for (const fs::path& file : {folder.image, folder.output, folder.errors})
        if (reachedLimit(file))
            throw call.failure("wrote " + std::to_string(largestFileMib) + " MiB or more into " +
                               (file == folder.image    ? "the image"
                                : file == folder.output ? "standard output"
                                                        : "standard error"));
    const std::string line = lastLineIn(folder.errors);
    const std::string said = line.empty() ? "" : ": " + line;
    if (WIFSIGNALED(status)) throw call.failure("was ended by signal " + std::to_string(WTERMSIG(status)) + said);
    if (WEXITSTATUS(status) != 0) throw call.failure("ended with status " + std::to_string(WEXITSTATUS(status)) + said);
    std::error_code none;
    if (!fs::is_regular_file(fs::symlink_status(folder.image, none))) throw call.failure("wrote no image" + said);
    cv::Mat image = decoded(call, folder.image);
    if (const std::string fault = faultOfOwnImage(image); !fault.empty())
        throw call.failure("wrote an image of " + fault, expectedOwnImage());
    return image;
}

UsedProgram usedProgramOf(const OwnProgram& own)
{
    UsedProgram used{own, protocols::sha256OfFile(own.program), {}, {}};
    std::error_code none;
    for (const std::string& argument : own.arguments)
        if (fs::is_regular_file(argument, none)) used.filesSha256[argument] = protocols::sha256OfFile(argument);
    return used;
}

}  // namespace

ProgramImages imagesOfPrograms(const std::vector<OwnProgram>& programs, const rendering::fabrics::Dataset& dataset,
                               const std::vector<protocols::FabricId>& fabrics,
                               const std::map<protocols::FabricId, rendering::SampleChoice>& samples, const ProgramLimits& limits,
                               const std::function<void(const std::string& stage, int done, int total)>& progress)
{
    ProgramImages all;
    const rendering::fabrics::PhotographViews views(dataset);
    const auto total = static_cast<int>(fabrics.size());
    for (const OwnProgram& own : programs) {
        UsedProgram used = usedProgramOf(own);
        std::map<protocols::FabricId, cv::Mat> images;
        for (const protocols::FabricId& fabric : fabrics) {
            const int index = samples.at(fabric).visual;
            const ProgramCall call{
                own, samplePath(dataset, fabric, rendering::fabrics::Modality::Visual, index),
                "fabric " + fabric.value + " (" + std::to_string(images.size() + 1) + " of " + std::to_string(total) + ")",
                limits};
            images[fabric] = imageFrom(call, readPhotograph(dataset, fabric, index), views.mmPerPixel(fabric, index));
            if (progress) progress("images by the program of " + own.condition.value, static_cast<int>(images.size()), total);
        }
        addOwnImages(all.own, own.condition, std::move(images));
        used.imagesSha256 = all.own.sha256.at(own.condition.value);
        all.used.push_back(std::move(used));
    }
    return all;
}

}  // namespace study::making
