// File code -> ready friction image: all that a session ever asks rendering for. It knows nothing of
// fabrics and conditions. Stimulus files have equal size (PGM) and an equal time stamp.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "protocols/ids.h"

namespace rendering {

/// Writes stimuli/<code>.pgm with the fixed time stamp and returns its SHA-256. The bytes reach the disk with the study
/// folder, which is synced as a whole.
std::string writeStimulus(const std::filesystem::path& stimuli, const protocols::FileCode& code, const cv::Mat& image);

class StimulusBank {
public:
    /// `hashes`: SHA-256 of each stimulus, from the study's database.
    StimulusBank(std::filesystem::path stimuli, std::map<protocols::FileCode, std::string> hashes);

    /// CV_8UC1 [800 x 1280]; the reference holds until another three are asked for. Throws workFailed
    /// where the file is missing or altered.
    const cv::Mat& image(const protocols::FileCode& code);

    /// Reads it now, so that showing it later takes no time that tells anything. Keeps the last few.
    void prefetch(const protocols::FileCode& code);

    /// Every stimulus that is missing or altered, a line each.
    std::vector<std::string> faults() const;

private:
    std::filesystem::path m_stimuli;
    std::map<protocols::FileCode, std::string> m_hashes;
    std::map<protocols::FileCode, cv::Mat> m_ready;
    std::vector<protocols::FileCode> m_order;  ///< of m_ready, oldest use first
};

}  // namespace rendering
