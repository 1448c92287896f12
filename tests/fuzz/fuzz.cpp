// Feeds damaged inputs to the readers of this program, whose own sources are compiled with the address and undefined-behaviour
// sanitizers here. An input that reaches new branches joins the corpus of its run.
//
//   fuzz --list                                 names of the readers
//   fuzz READER [--seconds N] [--seed S]        one reader; 5 s and seed 1 unless told
//   fuzz --all [--seconds N] [--seed S]         every reader, as many at a time as there are cores
//   fuzz READER --file FILE                     one input, such as one that an earlier run kept
//
// A reader may return or refuse with protocols::Error. A crash, a report of a sanitizer, any other exception, and an input that
// takes more than 5 s of the processor or 60 s in all end the run with exit code 1. The input is kept, and its name is printed.
#include <fcntl.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QCoreApplication>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/random.h"
#include "tests/fuzz/coverage.h"
#include "tests/fuzz/readers.h"
#include "tests/support/mutated_files.h"

namespace {

namespace fs = std::filesystem;

// On a busy machine an input waits for its turn, which is no fault of the reader.
constexpr unsigned longestWorkS = 5, longestInputS = 60;

struct Call {
    std::string reader;
    bool isList = false, isAll = false;
    double seconds = 5;
    std::uint64_t seed = 1;
    std::optional<std::string> file;
};

// The input at work, for handlers that must not allocate.
const std::string* present = nullptr;
std::string keptAs;

void keepPresent()
{
    if (present == nullptr) return;
    const int file = ::open(keptAs.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    [[maybe_unused]] const ssize_t count = ::write(file, present->data(), present->size());
    std::fprintf(stderr, "fuzz: the input is kept as %s\n", keptAs.c_str());
    present = nullptr;
}

void endSlowInput(int signal)
{
    const bool isWork = signal == SIGPROF;
    std::fprintf(stderr, "fuzz: an input took longer than %u s%s\n", isWork ? longestWorkS : longestInputS,
                 isWork ? " of the processor" : "");
    keepPresent();
    std::_Exit(1);
}

/// 0 for both: no limit.
void limit(unsigned workS, unsigned inputS)
{
    const itimerval work{{0, 0}, {static_cast<time_t>(workS), 0}};
    ::setitimer(ITIMER_PROF, &work, nullptr);
    ::alarm(inputS);
}

enum class Outcome { Taken, Refused };

Outcome outcomeOf(const fuzz::Reader& reader, const std::string& bytes)
{
    present = &bytes;
    limit(longestWorkS, longestInputS);
    Outcome outcome = Outcome::Taken;
    try {
        reader.read(bytes);
    } catch (const protocols::Error&) {
        outcome = Outcome::Refused;
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "fuzz: %s threw: %s\n", reader.name.c_str(), fault.what());
        keepPresent();
        std::_Exit(1);
    }
    limit(0, 0);
    present = nullptr;
    return outcome;
}

/// A member of the corpus, perhaps with a part of another one, after some mutations.
std::string nextInput(const std::vector<std::string>& corpus, std::size_t largest, protocols::Random& random)
{
    std::string text = corpus[random.below(corpus.size())];
    if (random.below(4) == 0) {
        const std::string& other = corpus[random.below(corpus.size())];
        const std::size_t from = random.below(other.size() + 1);
        text = text.substr(0, random.below(text.size() + 1)) + other.substr(from);
    }
    text = mutated_files::mutated(text, random);
    if (text.size() > largest) text.resize(largest);
    return text;
}

void fuzzOne(const fuzz::Reader& reader, const Call& call)
{
    using Clock = std::chrono::steady_clock;
    keptAs = (fs::temp_directory_path() / ("vis2hap-fuzz-" + reader.name + "-" + std::to_string(call.seed))).string();
    auto random = protocols::Random::stream(call.seed, reader.name);
    std::vector<std::string> corpus = reader.makeCorpus ? reader.makeCorpus() : reader.corpus;
    if (outcomeOf(reader, corpus.front()) != Outcome::Taken) {
        std::fprintf(stderr, "fuzz: %s refuses its sound input\n", reader.name.c_str());
        std::_Exit(1);
    }
    std::uint64_t taken = 0, refused = 0;
    const auto end = Clock::now() + std::chrono::duration<double>(call.seconds);
    do {
        fuzz::hasNewCoverage();
        const std::string input = nextInput(corpus, reader.largestInput, random);
        fuzz::hasNewCoverage();  // what the mutations reach does not count
        ++(outcomeOf(reader, input) == Outcome::Taken ? taken : refused);
        if (fuzz::hasNewCoverage()) corpus.push_back(input);
    } while (Clock::now() < end);
    std::printf("%-20s seed %llu, %.0f s: %llu taken, %llu refused, corpus of %zu\n", reader.name.c_str(),
                static_cast<unsigned long long>(call.seed), call.seconds, static_cast<unsigned long long>(taken),
                static_cast<unsigned long long>(refused), corpus.size());
    std::fflush(stdout);
}

/// Runs the reader in this process. Returns the exit code.
int runReader(const Call& call)
{
    const protocols::TemporaryFolder folder;
    for (const fuzz::Reader& reader : fuzz::allReaders(folder.path())) {
        if (reader.name != call.reader) continue;
        if (call.file) {
            std::ifstream in(*call.file, std::ios::binary);
            keptAs = *call.file + "-again";
            const std::string bytes{std::istreambuf_iterator<char>(in), {}};
            std::puts(outcomeOf(reader, bytes) == Outcome::Taken ? "taken" : "refused");
        } else {
            fuzzOne(reader, call);
        }
        return 0;
    }
    std::fprintf(stderr, "fuzz: there is no reader %s; fuzz --list names them\n", call.reader.c_str());
    return 2;
}

std::vector<std::string> namesOfReaders()
{
    const protocols::TemporaryFolder folder;
    std::vector<std::string> names;
    for (const fuzz::Reader& reader : fuzz::allReaders(folder.path())) names.push_back(reader.name);
    return names;
}

/// Every reader in a process of its own, so that one fault does not hide another. Returns 1 where any of them failed.
int runAll(const Call& call, const char* program)
{
    const unsigned most = std::max(1U, std::thread::hardware_concurrency());
    unsigned running = 0;
    int code = 0;
    const auto waitForOne = [&] {
        int status = 0;
        if (::wait(&status) < 0 || status != 0) code = 1;
        --running;
    };
    for (const std::string& name : namesOfReaders()) {
        if (running == most) waitForOne();
        const std::string seconds = std::to_string(call.seconds), seed = std::to_string(call.seed);
        if (::fork() == 0) {
            ::execl(program, program, name.c_str(), "--seconds", seconds.c_str(), "--seed", seed.c_str(), nullptr);
            std::_Exit(1);
        }
        ++running;
    }
    while (running > 0) waitForOne();
    return code;
}

std::optional<Call> callFrom(const std::vector<std::string>& words)
{
    Call call;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool hasValue = i + 1 < words.size();
        if (words[i] == "--list")
            call.isList = true;
        else if (words[i] == "--all")
            call.isAll = true;
        else if (words[i] == "--seconds" && hasValue)
            call.seconds = std::atof(words[++i].c_str());
        else if (words[i] == "--seed" && hasValue)
            call.seed = std::strtoull(words[++i].c_str(), nullptr, 10);
        else if (words[i] == "--file" && hasValue)
            call.file = words[++i];
        else if (!words[i].starts_with("--") && call.reader.empty())
            call.reader = words[i];
        else
            return std::nullopt;
    }
    const int wanted = int(call.isList) + int(call.isAll) + int(!call.reader.empty());
    return wanted == 1 ? std::optional(call) : std::nullopt;
}

}  // namespace

// A huge request of memory is a fault of the reader: std::bad_alloc ends the run.
extern "C" const char* __asan_default_options()
{
    return "max_allocation_size_mb=1024:allocator_may_return_null=1:handle_abort=1:detect_leaks=0";
}

extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1"; }

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);  // Qt loads its SQLite driver as a plug-in
    const auto call = callFrom({argv + 1, argv + argc});
    if (!call) {
        std::fputs("fuzz: expected --list, --all or READER, with --seconds N, --seed S or --file FILE\n", stderr);
        return 2;
    }
    __sanitizer_set_death_callback(keepPresent);
    std::signal(SIGALRM, endSlowInput);
    std::signal(SIGPROF, endSlowInput);
    if (call->isAll) return runAll(*call, argv[0]);
    if (!call->isList) return runReader(*call);
    for (const std::string& name : namesOfReaders()) std::puts(name.c_str());
    return 0;
}
