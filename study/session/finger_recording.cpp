#include "study/session/finger_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace study::session {

void FingerRecording::restart() { *this = FingerRecording(); }

void FingerRecording::add(const protocols::FingerSample& sample)
{
    protocols::FingerSample finite = sample;
    bool isEmpty = true;
    for (std::optional<double>* value : {&finite.xMm, &finite.yMm, &finite.forceN}) {
        if (*value && !std::isfinite(**value)) value->reset();
        isEmpty = isEmpty && !*value;
    }
    const bool isTooClose = m_dueNs && finite.atNs < *m_dueNs - leastGapNs / 2;
    if (isEmpty || isTooClose || m_kept >= mostSamples) {
        if (m_leftOut < std::numeric_limits<int>::max()) ++m_leftOut;
        return;
    }
    m_dueNs = std::max(m_dueNs.value_or(finite.atNs), finite.atNs) + leastGapNs;
    ++m_kept;
    m_samples.push_back(finite);
}

std::optional<database::SessionStore::FingerStretch> FingerRecording::unstored(protocols::TrialNumber trial) const
{
    if (m_samples.empty()) return std::nullopt;
    return database::SessionStore::FingerStretch{trial, m_samples, m_leftOut};
}

void FingerRecording::markStored()
{
    m_samples.clear();
    m_leftOut = 0;
}

}  // namespace study::session
