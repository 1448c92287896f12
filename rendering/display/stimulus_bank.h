// Friction images by file code, the only part of rendering that a session uses. It knows no fabrics and no conditions.
// Stimulus files have equal size (PGM) and equal time stamps.
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

    /// CV_8UC1 [800 x 1280]; the reference is valid until three other images are requested. Throws workFailed where the file
    /// is missing or altered.
    const cv::Mat& image(const protocols::FileCode& code);

    /// Reads the image now, so that the time to show it later reveals nothing. Keeps the last few images.
    void prefetch(const protocols::FileCode& code);

    /// One line for each stimulus that is missing or altered.
    std::vector<std::string> faults() const;

private:
    std::filesystem::path m_stimuli;
    std::map<protocols::FileCode, std::string> m_hashes;
    std::map<protocols::FileCode, cv::Mat> m_ready;
    std::vector<protocols::FileCode> m_order;  ///< codes in m_ready, oldest use first
};

}  // namespace rendering
