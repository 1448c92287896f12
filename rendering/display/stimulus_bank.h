// The sealed friction images of a study, the only part of rendering that a session uses. It knows no fabrics and no conditions.
// Each file is encrypted and bound to its name. All have equal size and equal time stamps, and all are read when the bank is
// made: neither a file nor the time to show it tells which image a presentation has.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/ids.h"
#include "protocols/secrets/secret_key.h"

namespace rendering {

/// SHA-256 of each stimulus file, from the study's database.
using StimulusHashes = std::map<protocols::FileCode, std::string>;

/// Writes stimuli/<code>.sealed (mode 0600) with the fixed time stamp and returns its SHA-256. The bytes reach the disk with the
/// study folder, which is synced as a whole. `image`: CV_8UC1, of equal size in one study.
std::string writeStimulus(const std::filesystem::path& stimuli, const protocols::FileCode& code, const cv::Mat& image,
                          const protocols::SecretKey& stationKey);

/// The image of sealed bytes, CV_8UC1; an empty one where the key or the bound text is another, or a bit was changed. `where`
/// names the source in errors.
cv::Mat openedStimulus(const protocols::SecretKey& key, std::string_view sealed, std::string_view bound,
                       const std::filesystem::path& where);

/// The friction images that a session presents.
class PresentedImages {
public:
    virtual ~PresentedImages() = default;

    /// CV_8UC1 [800 x 1280]; the reference is valid until three other images are requested.
    virtual const cv::Mat& image(const protocols::SealedCode& code) = 0;
    /// Throws as image() does where the study has no such image; decrypts no image.
    virtual void requireImage(const protocols::SealedCode& code) const = 0;
    /// Decrypts the image now, while the operator fills the tray. Keeps the last few images.
    virtual void prefetch(const protocols::SealedCode& code) = 0;
    /// Whether image() gives a ticket in place of the image: its text as one row of pixels. Only a display that fetches images
    /// can show it.
    virtual bool givesTickets() const { return false; }
};

class StimulusBank final : public PresentedImages {
public:
    /// Reads all files. Throws workFailed where one is missing or altered, or was sealed with another key.
    StimulusBank(const std::filesystem::path& stimuli, const StimulusHashes& hashes, const protocols::SecretKey& stationKey);

    const cv::Mat& image(const protocols::SealedCode& code) override;
    const cv::Mat& imageOf(const protocols::FileCode& code);

    void requireImage(const protocols::SealedCode& code) const override;
    void prefetch(const protocols::SealedCode& code) override;

private:
    const std::string& sealedOf(const protocols::FileCode& code) const;
    void makeReady(const protocols::FileCode& code);

    std::filesystem::path m_stimuli;
    protocols::SecretKey m_stationKey;
    std::map<protocols::FileCode, std::string> m_sealed;
    std::map<protocols::FileCode, cv::Mat> m_ready;
    std::vector<protocols::FileCode> m_order;  ///< codes in m_ready, oldest use first
};

/// One line for each stimulus that is missing or altered. Needs no key.
std::vector<std::string> faultsOfStimuli(const std::filesystem::path& stimuli, const StimulusHashes& hashes);

}  // namespace rendering
