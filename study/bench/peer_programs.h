// Other people's programs, timed on the same work: /usr/bin/python3 with scipy and scikit-image, and R.
// One thread each.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace study::bench {

/// Path of a script of tests/study/bench/peers: in the folder `peers` beside the running program, else in the source tree.
/// Throws environmentFault where it is in neither.
std::filesystem::path peerScript(const std::string& name);

/// Milliseconds by stage and peer; no number where the peer or its package is not installed.
using PeerTimes = std::map<std::string, std::map<std::string, std::optional<double>>>;

/// Stages: "paired t", "bca", "ssim", "ssim float". Half a minute at most.
PeerTimes peerTimes();

/// scipy alone: "cosine transforms 480x640" (float, there and back) and "integration 480x640" (its transforms, numpy's
/// differences, in single precision). A few seconds.
PeerTimes signalPeerTimes();

}  // namespace study::bench
