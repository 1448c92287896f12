#include "rendering/display/stimulus_bank.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "rendering/images/image_io.h"

namespace rendering {

namespace {

constexpr std::time_t stimulusTime = 946684800;  // 2000-01-01 00:00:00 UTC
constexpr std::size_t keptReady = 4;

std::filesystem::path pathOf(const std::filesystem::path& stimuli, const protocols::FileCode& code)
{
    return stimuli / (code.value + ".pgm");
}

/// "" for a sound stimulus.
std::string faultOf(const std::filesystem::path& file, const std::string& hash)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return "the stimulus is missing";
    try {
        return protocols::sha256OfFile(file) == hash ? "" : "the stimulus was altered";
    } catch (const protocols::Error&) {
        return "the stimulus cannot be read";
    }
}

protocols::Error unusable(const std::string& what, const std::filesystem::path& file)
{
    return protocols::workFailed({.what = what,
                                  .where = file.string(),
                                  .expected = "the file that the study was made with",
                                  .nextStep = "restore it from a backup; vis2hap verify lists all faults"});
}

}  // namespace

std::string writeStimulus(const std::filesystem::path& stimuli, const protocols::FileCode& code, const cv::Mat& image)
{
    const auto file = pathOf(stimuli, code);
    writePgm(file, image, protocols::Sync::Later);
    // When a stimulus was made and by whom it may be read would tell one from another.
    const timespec times[2] = {{stimulusTime, 0}, {stimulusTime, 0}};
    if (chmod(file.c_str(), 0644) != 0 || utimensat(AT_FDCWD, file.c_str(), times, 0) != 0)
        throw protocols::environmentFault({.what = std::string("the time stamp cannot be set (") + std::strerror(errno) + ")",
                                           .where = file.string(),
                                           .expected = "a folder of ours on a local disk",
                                           .nextStep = "choose another place for the study"});
    return protocols::sha256OfFile(file);
}

StimulusBank::StimulusBank(std::filesystem::path stimuli, std::map<protocols::FileCode, std::string> hashes)
    : m_stimuli(std::move(stimuli)), m_hashes(std::move(hashes))
{
}

const cv::Mat& StimulusBank::image(const protocols::FileCode& code)
{
    prefetch(code);
    return m_ready.at(code);
}

void StimulusBank::prefetch(const protocols::FileCode& code)
{
    const auto file = pathOf(m_stimuli, code);
    if (const auto place = std::find(m_order.begin(), m_order.end(), code); place != m_order.end()) {
        std::rotate(place, place + 1, m_order.end());
        return;
    }
    const auto hash = m_hashes.find(code);
    if (hash == m_hashes.end()) throw unusable("the study has no stimulus of this name", file);
    if (const auto fault = faultOf(file, hash->second); !fault.empty()) throw unusable(fault, file);
    m_ready[code] = readPgm(file);
    m_order.push_back(code);
    if (m_order.size() > keptReady) {
        m_ready.erase(m_order.front());
        m_order.erase(m_order.begin());
    }
}

std::vector<std::string> StimulusBank::faults() const
{
    std::vector<std::string> lines;
    for (const auto& [code, hash] : m_hashes) {
        const auto file = pathOf(m_stimuli, code);
        if (const auto fault = faultOf(file, hash); !fault.empty()) lines.push_back(file.string() + ": " + fault);
    }
    return lines;
}

}  // namespace rendering
