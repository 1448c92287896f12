#include "study/session/station_images.h"

#include "protocols/files/errors.h"

namespace study::session {

namespace {

constexpr std::size_t keptImages = 4;
constexpr const char* source = "the server";

}  // namespace

const cv::Mat& StationImages::image(const protocols::SealedCode& code)
{
    const auto ready = m_ready.find(code);
    if (ready != m_ready.end() && !m_store.givesTickets()) return ready->second;  // tickets do not hold for long
    const database::ReleasedImage released = m_store.image(code);
    if (m_store.givesTickets()) {
        if (m_ready.size() >= keptImages) m_ready.clear();
        const std::vector<unsigned char> pixels(released.sealed.begin(), released.sealed.end());
        return m_ready[code] = cv::Mat(pixels, true).reshape(1, 1);
    }
    cv::Mat opened = rendering::openedStimulus(protocols::SecretKey::ofHex(released.key, source), released.sealed,
                                               database::releasedImageBound, source);
    if (opened.empty())
        throw protocols::workFailed({"the image of this presentation was altered", source, "", "tell the owner of the study"});
    if (m_ready.size() >= keptImages) m_ready.clear();
    return m_ready[code] = std::move(opened);
}

void StationImages::requireImage(const protocols::SealedCode& code) const { (void)m_store.image(code); }

}  // namespace study::session
