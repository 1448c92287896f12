// Other programs timed on the same work, one thread each: /usr/bin/python3 with scipy and scikit-image, and R. Their scripts
// are files in tests/study/bench/peers.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace study::bench {

/// Path of a script of tests/study/bench/peers: in the folder `peers` beside the running program, else in the source tree.
/// Throws environmentFault where it is in neither.
std::filesystem::path peerScript(const std::string& name);

/// What a peer measured on a stage; none where the peer or its package is not installed.
struct PeerResult {
    std::optional<double> milliseconds;
    std::optional<double> answer;  ///< its result for the input that our stage has
};

/// By stage and peer.
using PeerResults = std::map<std::string, std::map<std::string, PeerResult>>;

/// scipy, R and scikit-image on "paired t", "bca", "ssim" and "ssim float", with the input of `bench statistics`. Takes at most
/// half a minute.
PeerResults statisticsPeers();

/// scipy on "cosine transforms 480x640" (single precision, forward and inverse) and "integration 480x640" (scipy's
/// transforms and numpy's differences, single precision), with the weave of `bench signals`. Takes a few seconds.
PeerResults signalPeers();

/// Standard output of a program; empty where it cannot be started or fails. Settings of the BLAS that this machine's owner made
/// for other work are left out, so that peers run as installed.
std::string outputOfPeer(const std::vector<std::string>& command);

/// The environment of this process without those settings and without secrets: "NAME=value".
std::vector<std::string> peerEnvironment();

}  // namespace study::bench
