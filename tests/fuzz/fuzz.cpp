// Feeds damaged inputs to the readers of this program, whose own sources are compiled with the address and undefined-behaviour
// sanitizers here. The inputs of the corpus come first, as they are; then mutations of them. An input that reaches new branches
// joins the corpus of its run.
//
//   fuzz --list                                 names of the readers
//   fuzz READER [--seconds N] [--seed S]        one reader; 5 s and seed 1 unless told
//   fuzz --all [--seconds N] [--seed S]         every reader, as many at a time as there are cores
//   fuzz READER --file FILE                     one input, such as one that an earlier run kept
//   fuzz ... --record FILE                      adds a line for each reader that ended without a fault
//   fuzz --owed FILE [--seconds N]              the readers whose lines in FILE sum up to less than N seconds
//
// Seconds are those of the processor, so that a busy machine does not shorten a run. tests/fuzz/long_runs.csv is the record of
// the long runs.
//
// A reader may return or refuse with protocols::Error. A crash, a report of a sanitizer, any other exception, and an input that
// takes more than 5 s of the processor, 60 s in all (pauses do not count) or 3 GB end the run with exit code 1. The input is
// kept, and its name is printed.
#include <fcntl.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QCoreApplication>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"
#include "tests/fuzz/changed_json.h"
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
    std::optional<std::string> file, record, owed;
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

[[noreturn]] void endSlowInput(unsigned seconds, const char* ofWhat)
{
    std::fprintf(stderr, "fuzz: an input took longer than %u s%s\n", seconds, ofWhat);
    keepPresent();
    std::_Exit(1);
}

void endOfWork(int) { endSlowInput(longestWorkS, " of the processor"); }

// Seconds of the present input. A process that is paused, or waits for its turn, misses signals; so this time does not count.
volatile std::sig_atomic_t inputSeconds = 0;

void countSecond(int)
{
    inputSeconds = inputSeconds + 1;
    if (inputSeconds >= static_cast<int>(longestInputS)) endSlowInput(longestInputS, "");
}

void limitInput(bool on)
{
    inputSeconds = 0;
    const itimerval work{{0, 0}, {on ? longestWorkS : 0, 0}}, each{{on, 0}, {on, 0}};
    ::setitimer(ITIMER_PROF, &work, nullptr);
    ::setitimer(ITIMER_REAL, &each, nullptr);
}

enum class Outcome { Taken, Refused };

Outcome outcomeOf(const fuzz::Reader& reader, const std::string& bytes)
{
    present = &bytes;
    limitInput(true);
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
    limitInput(false);
    present = nullptr;
    return outcome;
}

/// A member of the corpus, perhaps with a part of another one, after a change of its JSON or some mutations of its bytes.
std::string nextInput(const std::vector<std::string>& corpus, std::size_t largest, protocols::Random& random)
{
    std::string text = corpus[random.below(corpus.size())];
    if (random.below(4) == 0) {
        const std::string& other = corpus[random.below(corpus.size())];
        const std::size_t from = random.below(other.size() + 1);
        text = text.substr(0, random.below(text.size() + 1)) + other.substr(from);
    }
    bool isChanged = false;
    if (random.below(4) == 0) {
        std::string changed = fuzz::withChangedJson(text, random);
        isChanged = changed != text && random.below(2) == 0;
        text = std::move(changed);
    }
    if (!isChanged) text = mutated_files::mutated(text, random);
    if (text.size() > largest) text.resize(largest);
    return text;
}

/// Seconds of the processor that this process has used.
double workedSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What a run without a fault found.
struct Run {
    double seconds = 0;
    std::uint64_t taken = 0, refused = 0;
    std::size_t corpus = 0;
};

/// One write adds the line, so that readers side by side do not mix theirs.
void addToRecord(const fuzz::Reader& reader, const Call& call, const Run& run)
{
    const std::time_t now = std::time(nullptr);
    std::array<char, 16> day{};
    std::strftime(day.data(), day.size(), "%F", std::gmtime(&now));
    std::ostringstream line;
    line << reader.name << ',' << call.seed << ',' << static_cast<long>(run.seconds) << ',' << run.taken << ',' << run.refused
         << ',' << run.corpus << ',' << day.data() << '\n';
    const std::string text = line.str();
    const int file = ::open(call.record->c_str(), O_WRONLY | O_APPEND | O_CREAT, 0644);
    if (file < 0 || ::write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
        std::fprintf(stderr, "fuzz: %s cannot be written\n", call.record->c_str());
        std::_Exit(2);
    }
    ::close(file);
}

void fuzzOne(const fuzz::Reader& reader, const Call& call)
{
    keptAs = (fs::temp_directory_path() / ("vis2hap-fuzz-" + reader.name + "-" + std::to_string(call.seed))).string();
    auto random = protocols::Random::stream(call.seed, reader.name);
    std::vector<std::string> corpus = reader.makeCorpus ? reader.makeCorpus() : reader.corpus;
    if (outcomeOf(reader, corpus.front()) != Outcome::Taken) {
        std::fprintf(stderr, "fuzz: %s refuses its sound input\n", reader.name.c_str());
        std::_Exit(1);
    }
    Run run;
    const std::size_t given = corpus.size();
    std::size_t next = 1;
    const double begin = workedSeconds();
    do {
        fuzz::hasNewCoverage();
        const bool isGiven = next < given;  // first each input as it is
        const std::string input = isGiven ? corpus[next++] : nextInput(corpus, reader.largestInput, random);
        fuzz::hasNewCoverage();  // what the mutations reach does not count
        ++(outcomeOf(reader, input) == Outcome::Taken ? run.taken : run.refused);
        if (fuzz::hasNewCoverage() && !isGiven) corpus.push_back(input);
        run.seconds = workedSeconds() - begin;
    } while (run.seconds < call.seconds);
    run.corpus = corpus.size();
    std::printf("%-20s seed %llu, %.0f s: %llu taken, %llu refused, corpus of %zu\n", reader.name.c_str(),
                static_cast<unsigned long long>(call.seed), run.seconds, static_cast<unsigned long long>(run.taken),
                static_cast<unsigned long long>(run.refused), run.corpus);
    std::fflush(stdout);
    if (call.record) addToRecord(reader, call, run);
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
            ::execl(program, program, name.c_str(), "--seconds", seconds.c_str(), "--seed", seed.c_str(),
                    call.record ? "--record" : nullptr, call.record ? call.record->c_str() : nullptr, nullptr);
            std::_Exit(1);
        }
        ++running;
    }
    while (running > 0) waitForOne();
    return code;
}

/// Prints the readers that the record does not show for `call.seconds` yet. Returns the exit code.
int showOwed(const Call& call)
{
    std::map<std::string, double> seconds;
    const protocols::CsvTable record = protocols::csvTableFrom(protocols::readWholeFile(*call.owed), *call.owed);
    const auto reader = record.column("reader"), worked = record.column("seconds");
    if (!reader || !worked) {
        std::fprintf(stderr, "fuzz: %s has no columns reader and seconds\n", call.owed->c_str());
        return 2;
    }
    for (std::size_t row = 0; row < record.rows.size(); ++row)
        seconds[record.rows[row][*reader]] += protocols::numberAt(record, row, *worked);
    for (const std::string& name : namesOfReaders())
        if (seconds[name] < call.seconds) std::puts(name.c_str());
    return 0;
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
        else if (words[i] == "--record" && hasValue)
            call.record = words[++i];
        else if (words[i] == "--owed" && hasValue)
            call.owed = words[++i];
        else if (!words[i].starts_with("--") && call.reader.empty())
            call.reader = words[i];
        else
            return std::nullopt;
    }
    const int wanted = int(call.isList) + int(call.isAll) + int(call.owed.has_value()) + int(!call.reader.empty());
    return wanted == 1 ? std::optional(call) : std::nullopt;
}

}  // namespace

// A huge request of memory is a fault of the reader, and so are many small ones: both end the run.
extern "C" const char* __asan_default_options()
{
    return "max_allocation_size_mb=1024:hard_rss_limit_mb=3072:allocator_may_return_null=1:handle_abort=1:detect_leaks=0";
}

extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1"; }

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);  // Qt loads its SQLite driver as a plug-in
    const auto call = callFrom({argv + 1, argv + argc});
    if (!call) {
        std::fputs(
            "fuzz: expected --list, --all, --owed FILE or READER, with --seconds N, --seed S, --record FILE or --file FILE\n",
            stderr);
        return 2;
    }
    __sanitizer_set_death_callback(keepPresent);
    std::signal(SIGALRM, countSecond);
    std::signal(SIGPROF, endOfWork);
    if (call->isAll) return runAll(*call, argv[0]);
    if (call->owed) return showOwed(*call);
    if (!call->isList) return runReader(*call);
    for (const std::string& name : namesOfReaders()) std::puts(name.c_str());
    return 0;
}
