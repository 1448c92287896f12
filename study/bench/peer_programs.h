// Other programs timed on the same work, one thread each: /usr/bin/python3 with scipy and scikit-image, and R. Their scripts
// are files in tests/study/bench/peers.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace study::bench {

/// Path of a script of tests/study/bench/peers: in the folder `peers` beside the running program, else in the source tree.
/// Throws environmentFault where it is in neither.
std::filesystem::path peerScript(const std::string& name);

/// Milliseconds by stage and peer; none where the peer or its package is not installed.
using PeerTimes = std::map<std::string, std::map<std::string, std::optional<double>>>;

/// Times "paired t", "bca", "ssim" and "ssim float". Takes at most half a minute.
PeerTimes peerTimes();

/// Times scipy on "cosine transforms 480x640" (single precision, forward and inverse) and "integration 480x640" (scipy's
/// transforms and numpy's differences, single precision). Takes a few seconds.
PeerTimes signalPeerTimes();

}  // namespace study::bench
