// The friction images of a study on a server: each is given out with its presentation, sealed under a key of its own.
#pragma once

#include <map>

#include "database/server/station_store.h"
#include "rendering/display/stimulus_bank.h"

namespace study::session {

class StationImages final : public rendering::PresentedImages {
public:
    explicit StationImages(database::StationStore& store) : m_store(store) {}

    const cv::Mat& image(const protocols::SealedCode& code) override;
    void requireImage(const protocols::SealedCode& code) const override;
    void prefetch(const protocols::SealedCode& code) override { (void)image(code); }
    bool givesTickets() const override { return m_store.givesTickets(); }

private:
    database::StationStore& m_store;
    std::map<protocols::SealedCode, cv::Mat> m_ready;
};

}  // namespace study::session
