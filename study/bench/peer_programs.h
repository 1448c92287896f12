// Other people's programs, timed on the same work: /usr/bin/python3 with scipy and scikit-image, and R.
// One thread each.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace study::bench {

/// Milliseconds by stage and peer; no number where the peer or its package is not installed.
using PeerTimes = std::map<std::string, std::map<std::string, std::optional<double>>>;

/// Stages: "paired t", "bca", "ssim", "ssim float". Half a minute at most.
PeerTimes peerTimes();

/// scipy alone: "cosine transforms 480x640" (float, there and back) and "integration 480x640" (its transforms, numpy's
/// differences, in single precision). A few seconds.
PeerTimes signalPeerTimes();

}  // namespace study::bench
