#include "rendering/display/stimulus_bank.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/orders/allocation.h"
#include "protocols/records/sealed_stimulus.h"
#include "protocols/secrets/sealing.h"
#include "rendering/images/image_io.h"

namespace rendering {

namespace {

constexpr std::size_t keptReady = 4;

// A sealed image of 16,384 x 16,384 pixels fits.
constexpr std::uintmax_t largestStimulus = std::uintmax_t{1} << 29;

protocols::Error notUsable(const std::string& what, const std::filesystem::path& file)
{
    return protocols::workFailed({.what = what,
                                  .where = file.string(),
                                  .expected = "the file from the making of the study",
                                  .nextStep = "restore it from a backup; vis2hap verify lists all faults"});
}

/// Why the file cannot be read as a stimulus of at most `mostBytes`; empty where it can. Nothing is read.
std::string whyUnreadable(const std::filesystem::path& file, std::uintmax_t mostBytes)
{
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0)
        return errno == ENOENT ? "the stimulus is missing"
                               : std::string("the stimulus cannot be read (") + std::strerror(errno) + ")";
    if (!S_ISREG(status.st_mode)) return "the stimulus is missing: what stands in its place is no file";
    if (const auto size = static_cast<std::uintmax_t>(status.st_size); size > mostBytes)
        return "the stimulus was altered: it has " + std::to_string(size) + " bytes, and at most " + std::to_string(mostBytes) +
               " are right";
    if (::faccessat(AT_FDCWD, file.c_str(), R_OK, AT_EACCESS) != 0)
        return std::string("the stimulus cannot be read (") + std::strerror(errno) + ")";
    return {};
}

/// Fault of a stimulus; empty for a sound one.
std::string faultOf(const std::filesystem::path& file, const std::string& hash, std::uintmax_t mostBytes)
{
    if (auto why = whyUnreadable(file, mostBytes); !why.empty()) return why;
    try {
        return protocols::sha256OfFile(file) == hash ? "" : "the stimulus was altered";
    } catch (const protocols::Error&) {
        return "the stimulus cannot be read";
    }
}

/// Most bytes of a stimulus: all stimuli of a study have one length. The commonest size of the files is taken for it, and the
/// smallest of several that are as common.
std::uintmax_t commonSize(const std::filesystem::path& stimuli, const StimulusHashes& hashes)
{
    std::map<std::uintmax_t, std::size_t> counts;
    for (const auto& [code, hash] : hashes) {
        std::error_code unknown;
        const auto size = std::filesystem::file_size(protocols::stimulusFile(stimuli, code), unknown);
        if (!unknown) ++counts[std::min<std::uintmax_t>(size, largestStimulus)];
    }
    const auto commonest = std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; });
    return commonest == counts.end() ? largestStimulus : commonest->first;
}

}  // namespace

std::string writeStimulus(const std::filesystem::path& stimuli, const protocols::FileCode& code, const cv::Mat& image,
                          const protocols::SecretKey& stationKey)
{
    return protocols::writeSealedStimulus(stimuli, code, pgmBytes(image), stationKey);
}

cv::Mat openedStimulus(const protocols::SecretKey& key, std::string_view sealed, std::string_view bound,
                       const std::filesystem::path& where)
{
    const auto bytes = protocols::open(key, sealed, bound);
    return bytes ? pgmOfBytes(*bytes, where) : cv::Mat();
}

StimulusBank::StimulusBank(const std::filesystem::path& stimuli, const StimulusHashes& hashes,
                           const protocols::SecretKey& stationKey)
    : m_stimuli(stimuli), m_stationKey(stationKey)
{
    for (const auto& [code, hash] : hashes) {
        const auto file = protocols::stimulusFile(stimuli, code);
        if (const auto why = whyUnreadable(file, largestStimulus); !why.empty()) throw notUsable(why, file);
        auto sealed = protocols::readIfPossible(file);
        if (!sealed) throw notUsable("the stimulus cannot be read", file);
        if (!protocols::open(stationKey, *sealed, code.value)) throw notUsable("the stimulus was altered", file);
        m_sealed.emplace(code, std::move(*sealed));
    }
}

const cv::Mat& StimulusBank::image(const protocols::SealedCode& code) { return imageOf(protocols::opened(code, m_stationKey)); }

const cv::Mat& StimulusBank::imageOf(const protocols::FileCode& code)
{
    makeReady(code);
    return m_ready.at(code);
}

void StimulusBank::requireImage(const protocols::SealedCode& code) const
{
    (void)sealedOf(protocols::opened(code, m_stationKey));
}

void StimulusBank::prefetch(const protocols::SealedCode& code) { makeReady(protocols::opened(code, m_stationKey)); }

const std::string& StimulusBank::sealedOf(const protocols::FileCode& code) const
{
    const auto sealed = m_sealed.find(code);
    if (sealed == m_sealed.end())
        throw notUsable("the study has no stimulus of this name", protocols::stimulusFile(m_stimuli, code));
    return sealed->second;
}

void StimulusBank::makeReady(const protocols::FileCode& code)
{
    if (const auto place = std::find(m_order.begin(), m_order.end(), code); place != m_order.end()) {
        std::rotate(place, place + 1, m_order.end());
        return;
    }
    const auto file = protocols::stimulusFile(m_stimuli, code);
    cv::Mat image = openedStimulus(m_stationKey, sealedOf(code), code.value, file);
    if (image.empty()) throw notUsable("the stimulus was altered", file);
    m_ready[code] = std::move(image);
    m_order.push_back(code);
    if (m_order.size() > keptReady) {
        m_ready.erase(m_order.front());
        m_order.erase(m_order.begin());
    }
}

std::vector<std::string> faultsOfStimuli(const std::filesystem::path& stimuli, const StimulusHashes& hashes)
{
    std::vector<std::string> lines;
    const std::uintmax_t mostBytes = commonSize(stimuli, hashes);
    for (const auto& [code, hash] : hashes) {
        const auto file = protocols::stimulusFile(stimuli, code);
        if (const auto fault = faultOf(file, hash, mostBytes); !fault.empty()) lines.push_back(file.string() + ": " + fault);
    }
    return lines;
}

}  // namespace rendering
