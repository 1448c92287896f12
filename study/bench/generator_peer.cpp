#include "study/bench/generator_peer.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "rendering/models/process/child_process.h"
#include "rendering/models/process/second_program.h"
#include "study/bench/peer_programs.h"

namespace study::bench {

namespace {

constexpr const char* referenceBlas = "/usr/lib/x86_64-linux-gnu/blas:/usr/lib/x86_64-linux-gnu/lapack";
constexpr double answersMayDiffer = 1e-3;  ///< for numbers of about ten, in single precision

double numberIn(const std::string& text)
{
    double number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc())
        throw protocols::workFailed({"a peer answered '" + text + "'", "bench --peers", "milliseconds", ""});
    return number;
}

/// A program that answers each line with a line. It ends at the end of its input.
class Partner {
public:
    Partner(std::vector<std::string> command, const std::string& libraries);
    ~Partner();
    Partner(const Partner&) = delete;
    Partner& operator=(const Partner&) = delete;

    std::string line();  ///< empty where the program has ended
    double asked(const std::string& order);

private:
    pid_t m_child = 0;
    int m_to = -1;
    FILE* m_from = nullptr;
};

Partner::Partner(std::vector<std::string> command, const std::string& libraries)
{
    std::array<int, 2> to{}, from{};
    if (pipe2(to.data(), O_CLOEXEC) != 0 || pipe2(from.data(), O_CLOEXEC) != 0)
        throw protocols::environmentFault({"cannot make a pipe", "bench --peers", "", ""});
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // The same settings as in our program: threads that wait by spinning would slow the other partner.
    std::vector<std::string> surroundings;
    for (const auto& [name, value] : rendering::models::missingThreadSettings()) surroundings.push_back(name + "=" + value);
    if (!libraries.empty()) surroundings.push_back("LD_LIBRARY_PATH=" + libraries);
    std::vector<char*> variables, words;
    for (std::string& text : surroundings) variables.push_back(text.data());
    std::vector<std::string> others = peerEnvironment();
    for (std::string& text : others) variables.push_back(text.data());
    variables.push_back(nullptr);
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    if (posix_spawnp(&m_child, words.front(), &actions, nullptr, words.data(), variables.data()) != 0) m_child = 0;
    posix_spawn_file_actions_destroy(&actions);
    close(to[0]);
    close(from[1]);
    m_to = to[1];
    m_from = fdopen(from[0], "r");
}

Partner::~Partner()
{
    close(m_to);
    fclose(m_from);
    int status = 0;
    while (m_child > 0 && waitpid(m_child, &status, 0) < 0 && errno == EINTR) {
    }
}

std::string Partner::line()
{
    std::string text;
    for (int letter = 0; (letter = fgetc(m_from)) != EOF && letter != '\n';) text += static_cast<char>(letter);
    return text;
}

double Partner::asked(const std::string& order)
{
    const std::string words = order + "\n";
    if (write(m_to, words.data(), words.size()) != static_cast<ssize_t>(words.size()))
        throw protocols::workFailed({"a peer ended early", "bench --peers", "", ""});
    return numberIn(line());
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Times both in turns. The first of a pair alternates, and one pair before the others warms both up.
void timeInTurns(Partner& ours, Partner& theirs, const std::string& order, int pairs, std::optional<double>& oursMs,
                 std::optional<double>& theirsMs, std::optional<double>& ratio)
{
    std::vector<double> first, second, ratios;
    for (int pair = -1; pair < pairs; ++pair) {
        const bool oursBegins = pair % 2 == 0;
        const double early = (oursBegins ? ours : theirs).asked(order), late = (oursBegins ? theirs : ours).asked(order);
        if (pair < 0) continue;
        first.push_back(oursBegins ? early : late);
        second.push_back(oursBegins ? late : early);
        ratios.push_back(first.back() / second.back());
    }
    oursMs = median(first);
    theirsMs = median(second);
    ratio = median(ratios);
}

void compare(Partner& ours, Partner& theirs, int pairs, PeerComparison& comparison)
{
    timeInTurns(ours, theirs, "train", pairs, comparison.oursTrainMs, comparison.theirsTrainMs, comparison.trainRatio);
    timeInTurns(ours, theirs, "infer", pairs, comparison.oursInferMs, comparison.theirsInferMs, comparison.inferRatio);
}

std::vector<std::string> wordsOf(const std::string& line)
{
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

PeerComparison withPython(Partner& ours, const std::vector<std::string>& sizes, const std::filesystem::path& folder, int pairs)
{
    std::vector<std::string> command{"/usr/bin/python3", "-B", peerScript("generators_peer.py"), folder.string()};
    command.insert(command.end(), sizes.begin(), sizes.end());
    Partner python(command, "");
    const std::vector<std::string> ready = wordsOf(python.line());
    PeerComparison comparison;
    comparison.peer = "python torch";
    if (ready.size() != 3 || ready[0] != "ready") {
        comparison.whyNot = "python3-torch is not installed, or its networks differ from ours";
        return comparison;
    }
    comparison.peer += " " + ready[1];
    comparison.answersApart = numberIn(ready[2]);
    if (*comparison.answersApart > answersMayDiffer) {
        comparison.whyNot = "its networks give other outputs than ours";
        return comparison;
    }
    compare(ours, python, pairs, comparison);
    return comparison;
}

PeerComparison withReferenceBlas(Partner& ours, int pairs)
{
    PeerComparison comparison;
    comparison.peer = "ours on the reference BLAS";
    const protocols::TemporaryFolder folder;
    if (!std::filesystem::exists("/usr/lib/x86_64-linux-gnu/blas/libblas.so.3")) {
        comparison.whyNot = "libblas3 is not installed";
        return comparison;
    }
    Partner slow({rendering::models::secondProgram(), "peer-steps", folder.path().string()}, referenceBlas);
    if (!slow.line().starts_with("ready"))
        comparison.whyNot = "vis2hap-nn does not start on it";
    else
        compare(ours, slow, pairs, comparison);
    return comparison;
}

}  // namespace

std::vector<PeerComparison> compareGeneratorPeers(int pairs)
{
    ::signal(SIGPIPE, SIG_IGN);  // NOLINT: a peer that ends early is reported by name
    const protocols::TemporaryFolder folder;
    Partner ours({rendering::models::secondProgram(), "peer-steps", folder.path().string()}, "");
    std::vector<std::string> ready = wordsOf(ours.line());
    if (ready.size() != 6 || ready[0] != "ready")
        throw protocols::environmentFault({"the neural-network part cannot be started", rendering::models::secondProgram(),
                                           "vis2hap-nn and libtorch",
                                           "install libtorch (apt-get install libtorch-dev) or run ./run again"});
    ready.erase(ready.begin());
    return {withPython(ours, ready, folder.path(), pairs), withReferenceBlas(ours, pairs)};
}

}  // namespace study::bench
