#include "study/bench/peer_programs.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/secrets/secret_variables.h"
#include "protocols/shipped_folder.h"

namespace study::bench {

namespace {

constexpr const char* python = "/usr/bin/python3";

/// Stages with their peers, before any has answered.
PeerResults unanswered(const std::vector<std::pair<std::string, std::vector<std::string>>>& stages)
{
    PeerResults results;
    for (const auto& [stage, peers] : stages)
        for (const std::string& peer : peers) results[stage][peer] = {};
    return results;
}

std::optional<double> numberAt(const nlohmann::json& object, const char* field)
{
    const auto found = object.find(field);
    return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// Adds {"peer": {"stage": {"ms": X, "answer": Y}}}; null where a package is not installed.
void add(PeerResults& results, const std::string& output)
{
    const auto found = nlohmann::json::parse(output, nullptr, false);
    if (!found.is_object()) return;
    for (const auto& [peer, stages] : found.items())
        for (const auto& [stage, measured] : stages.items())
            if (measured.is_object()) results[stage][peer] = {numberAt(measured, "ms"), numberAt(measured, "answer")};
}

}  // namespace

std::vector<std::string> peerEnvironment()
{
    std::vector<std::string> variables = protocols::environmentWithoutSecrets();
    std::erase_if(variables, [](const std::string& text) {
        return text.starts_with("OPENBLAS_CORETYPE=") || text.starts_with("OPENBLAS_L2_SIZE=");
    });
    return variables;
}

std::string outputOfPeer(const std::vector<std::string>& command)
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
    std::vector<std::string> surroundings = peerEnvironment();
    std::vector<char*> variables;
    for (std::string& text : surroundings) variables.push_back(text.data());
    variables.push_back(nullptr);
    pid_t child = 0;
    const int failure = posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), variables.data());
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

std::filesystem::path peerScript(const std::string& name)
{
    auto script = protocols::shippedFolder("peers", VIS2HAP_SOURCE_DIR "/tests/study/bench/peers") / name;
    if (std::filesystem::exists(script)) return script;
    throw protocols::environmentFault({"the script of a peer is missing", script.string(), "this file of the program",
                                       "copy it from the sources of the program, or leave --peers out"});
}

PeerResults statisticsPeers()
{
    PeerResults results = unanswered({{"paired t", {"scipy", "R"}},
                                      {"bca", {"scipy", "R"}},
                                      {"ssim", {"scikit-image", "OpenCV"}},
                                      {"ssim float", {"scikit-image", "OpenCV"}}});
    add(results, outputOfPeer({python, "-B", peerScript("statistics_peer.py")}));
    add(results, outputOfPeer({"Rscript", peerScript("statistics_peer.R")}));
    return results;
}

PeerResults signalPeers()
{
    PeerResults results = unanswered({{"cosine transforms 480x640", {"scipy"}}, {"integration 480x640", {"scipy"}}});
    add(results, outputOfPeer({python, "-B", peerScript("signals_peer.py")}));
    return results;
}

}  // namespace study::bench
