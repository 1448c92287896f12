#include "study/bench/peer_programs.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "protocols/files/errors.h"

extern char** environ;

namespace study::bench {

namespace {

constexpr const char* python = "/usr/bin/python3";

/// Standard output of a program; empty where it cannot be started or fails.
std::string outputOf(const std::vector<std::string>& command)
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> argv;
    for (const std::string& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    const int failure = posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    std::string text;
    std::array<char, 4096> chunk{};
    for (ssize_t n = 0; failure == 0 && (n = read(ends[0], chunk.data(), chunk.size())) > 0;)
        text.append(chunk.data(), static_cast<std::size_t>(n));
    close(ends[0]);
    if (failure != 0) return {};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : std::string();
}

void add(PeerTimes& times, const std::string& output)
{
    const auto found = nlohmann::json::parse(output, nullptr, false);
    if (!found.is_object()) return;
    for (const auto& [peer, stages] : found.items())
        for (const auto& [stage, milliseconds] : stages.items())
            if (milliseconds.is_number()) times[stage][peer] = milliseconds.get<double>();
}

}  // namespace

std::filesystem::path peerScript(const std::string& name)
{
    const auto beside = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "peers" / name;
    if (std::filesystem::exists(beside)) return beside;
    auto inSources = std::filesystem::path(VIS2HAP_SOURCE_DIR) / "tests/study/bench/peers" / name;
    if (std::filesystem::exists(inSources)) return inSources;
    throw protocols::environmentFault({"the script of a peer is missing", inSources.string(), "this file, or " + beside.string(),
                                       "copy it from the sources of the program, or leave --peers out"});
}

PeerTimes peerTimes()
{
    PeerTimes times;
    for (const char* stage : {"paired t", "bca"}) times[stage] = {{"scipy", std::nullopt}, {"R", std::nullopt}};
    for (const char* stage : {"ssim", "ssim float"}) times[stage] = {{"scikit-image", std::nullopt}};
    add(times, outputOf({python, "-B", peerScript("statistics_peer.py")}));
    add(times, outputOf({"Rscript", peerScript("statistics_peer.R")}));
    return times;
}

PeerTimes signalPeerTimes()
{
    PeerTimes times;
    for (const char* stage : {"cosine transforms 480x640", "integration 480x640"}) times[stage] = {{"scipy", std::nullopt}};
    add(times, outputOf({python, "-B", peerScript("signals_peer.py")}));
    return times;
}

}  // namespace study::bench
