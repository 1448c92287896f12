#include "rendering/display/stimulus_bank.h"

#include <algorithm>
#include <utility>

#include "protocols/allocation.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/records/sealed_stimulus.h"
#include "protocols/secrets/sealing.h"
#include "rendering/images/image_io.h"

namespace rendering {

namespace {

constexpr std::size_t keptReady = 4;

protocols::Error notUsable(const std::string& what, const std::filesystem::path& file)
{
    return protocols::workFailed({.what = what,
                                  .where = file.string(),
                                  .expected = "the file from the making of the study",
                                  .nextStep = "restore it from a backup; vis2hap verify lists all faults"});
}

/// Fault of a stimulus; empty for a sound one.
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

}  // namespace

std::string writeStimulus(const std::filesystem::path& stimuli, const protocols::FileCode& code, const cv::Mat& image,
                          const protocols::SecretKey& stationKey)
{
    return protocols::writeSealedStimulus(stimuli, code, pgmBytes(image), stationKey);
}

StimulusBank::StimulusBank(const std::filesystem::path& stimuli, const StimulusHashes& hashes,
                           const protocols::SecretKey& stationKey)
    : m_stimuli(stimuli), m_stationKey(stationKey)
{
    for (const auto& [code, hash] : hashes) {
        const auto file = protocols::stimulusFile(stimuli, code);
        auto sealed = protocols::readIfPossible(file);
        if (!sealed) throw notUsable("the stimulus is missing", file);
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

void StimulusBank::prefetch(const protocols::SealedCode& code) { makeReady(protocols::opened(code, m_stationKey)); }

void StimulusBank::makeReady(const protocols::FileCode& code)
{
    if (const auto place = std::find(m_order.begin(), m_order.end(), code); place != m_order.end()) {
        std::rotate(place, place + 1, m_order.end());
        return;
    }
    const auto file = protocols::stimulusFile(m_stimuli, code);
    const auto sealed = m_sealed.find(code);
    if (sealed == m_sealed.end()) throw notUsable("the study has no stimulus of this name", file);
    const auto bytes = protocols::open(m_stationKey, sealed->second, code.value);
    if (!bytes) throw notUsable("the stimulus was altered", file);
    m_ready[code] = pgmOfBytes(*bytes, file);
    m_order.push_back(code);
    if (m_order.size() > keptReady) {
        m_ready.erase(m_order.front());
        m_order.erase(m_order.begin());
    }
}

std::vector<std::string> faultsOfStimuli(const std::filesystem::path& stimuli, const StimulusHashes& hashes)
{
    std::vector<std::string> lines;
    for (const auto& [code, hash] : hashes) {
        const auto file = protocols::stimulusFile(stimuli, code);
        if (const auto fault = faultOf(file, hash); !fault.empty()) lines.push_back(file.string() + ": " + fault);
    }
    return lines;
}

}  // namespace rendering
