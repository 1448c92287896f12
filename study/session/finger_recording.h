// What the display measures of the finger during one presentation, bounded in rate and number: a driver may send anything.
#pragma once

#include <optional>

#include "database/session_store.h"

namespace study::session {

class FingerRecording {
public:
    /// Mean time between kept samples at the highest rate, ns: 200 a second remain. One sample may come up to half of it early,
    /// so that a source of that rate loses none to its own jitter.
    static constexpr std::int64_t leastGapNs = 5'000'000;
    /// Samples of one presentation; 2 minutes at the highest rate.
    static constexpr int mostSamples = 24'000;

    /// Forgets everything: a new presentation begins.
    void restart();
    /// A value that is not finite is left out of the sample, and an empty sample is left out.
    void add(const protocols::FingerSample& sample);
    /// The samples that are not stored yet, for a trial; none if there are none.
    std::optional<database::SessionStore::FingerStretch> unstored(protocols::TrialNumber trial) const;
    void markStored();

private:
    std::vector<protocols::FingerSample> m_samples;
    std::optional<std::int64_t> m_dueNs;  ///< when the next sample is due at the highest rate
    int m_kept = 0;                       ///< of this presentation
    int m_leftOut = 0;                    ///< since the last call of markStored()
};

}  // namespace study::session
