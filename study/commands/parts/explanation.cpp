#include "study/commands/parts/explanation.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "protocols/files/number_text.h"
#include "protocols/process/opened_files.h"
#include "rendering/cache/result_cache.h"
#include "rendering/models/model_card.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

constexpr CommandNeeds table[] = {
    {"fabrics make", "nothing", "surfaces, photographs, tactile frames and friction records of drawn fabrics"},
    {"fabrics check", "every file of the data set", "its faults"},
    {"import", "the recordings", "their form in a data set"},
    {"calibrate", "the presses or the known surface", "the map from light to slope"},
    {"height", "frames and their calibration, or slopes, or a normal map", "slopes and the integrated height"},
    {"train", "the data set, or drawn fabrics", "the weights of the generators", Networks::Always},
    {"evaluate", "the test samples of the data set, and known samples for the controls",
     "generated signals, measured signals and their measures", Networks::Always},
    {"render", "the recordings of the rendered fabrics, and of those whose ranges are not kept",
     "the signals of each condition, ranges and friction images", Networks::IfGenerated},
    {"view", "the named files", "pictures", Networks::None, "picture formats of Qt"},
    {"stroke", "the image", "the friction force along the stroke"},
    {"study new",
     "the protocol, and the drawn samples of the data set; programs of `--program`; every file of the data set for its hash",
     "signals, friction images, the comparison of signals, running orders, seals", Networks::IfGenerated, "SQLite"},
    {"simulate", "the study and the presses of its fabrics", "simulated answers", Networks::None, "SQLite"},
    {"replay", "the study and the scripts", "the answers of scripted participants", Networks::None, "SQLite"},
    {"report", "the study and, after the unblinding, its friction images; or a table of answers",
     "statistics, tables, figures and pages", Networks::None, "SQLite, picture formats of Qt"},
    {"export", "the study", "its tables", Networks::None, "SQLite"},
    {"verify", "the study with all stimuli", "hashes and the chain of events", Networks::None, "SQLite"},
    {"leak-check", "the study, its exports, and the cache of signals", "attacks on the blinding", Networks::None, "SQLite"},
    {"power", "the protocol", "what the design can detect"},
    {"describe", "one column", "its statistics"},
    {"compare", "two columns", "a test"},
    {"metrics", "two images or traces", "MAE and SSIM"},
    {"analyse", "the requests and their arrays", "the statistics that they name"},
};

std::string networksText(Networks networks)
{
    switch (networks) {
        case Networks::None:
            return "none";
        case Networks::IfGenerated:
            return "vis2hap-nn with libtorch, only where a signal is generated and not kept";
        case Networks::Always:
            return "vis2hap-nn with libtorch";
    }
    return "";
}

/// "study new": the names of the called command and its parents.
std::string calledCommand(const CLI::App& app, const CLI::App*& called)
{
    std::string names;
    called = &app;
    for (auto below = app.get_subcommands(); !below.empty(); below = called->get_subcommands()) {
        called = below.front();
        names += (names.empty() ? "" : " ") + called->get_name();
    }
    return names;
}

CLI::App* commandNamed(CLI::App& app, const std::string& names)
{
    CLI::App* at = &app;
    std::istringstream words(names);
    for (std::string word; at != nullptr && words >> word;) {
        const auto found = at->get_subcommands([&](const CLI::App* one) { return one->get_name() == word; });
        at = found.empty() ? nullptr : found.front();
    }
    return at;
}

/// Files and folders that the options name.
std::vector<fs::path> namedPlaces(const CLI::App& command)
{
    std::vector<fs::path> places;
    std::error_code none;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& text : option->results())
            if (text.find('\0') == std::string::npos && fs::exists(text, none)) places.emplace_back(text);
    return places;
}

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6; }

std::string usageText(int who)
{
    rusage usage{};
    ::getrusage(who, &usage);
    return protocols::fixed(seconds(usage.ru_utime) + seconds(usage.ru_stime), 2) + " s of processor time, at most " +
           protocols::fixed(static_cast<double>(usage.ru_maxrss) / 1024, 0) + " MB of memory";
}

bool hadChildren()
{
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_maxrss > 0;
}

bool liesBelow(const fs::path& file, const fs::path& place)
{
    const auto [end, rest] = std::mismatch(place.begin(), place.end(), file.begin(), file.end());
    return end == place.end() || end->empty();
}

std::string countText(std::size_t count, const char* one, const char* several)
{
    return std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace

std::span<const CommandNeeds> commandNeeds() { return table; }

std::set<std::string> mappedLibraries()
{
    std::set<std::string> names;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        const auto slash = line.rfind('/');
        if (slash != std::string::npos && line.find(".so", slash) != std::string::npos) names.insert(line.substr(slash + 1));
    }
    return names;
}

Explanation::Explanation() : m_isAsked(std::make_shared<bool>(false)) {}
Explanation::~Explanation() = default;

void Explanation::addOptions(CLI::App& app)
{
    for (const CommandNeeds& needs : table)
        if (CLI::App* command = commandNamed(app, needs.command))
            command->add_flag("--explain", *m_isAsked,
                              "print what is read and computed: planned before the work, and found after it");
}

void Explanation::begin(const CLI::App& app)
{
    if (!*m_isAsked) return;
    const CLI::App* command = nullptr;
    const std::string name = calledCommand(app, command);
    const auto row = std::find_if(std::begin(table), std::end(table), [&](const auto& one) { return name == one.command; });
    if (row == std::end(table)) return;
    m_needs = row;
    const CLI::Option* json = command->get_option_no_throw("--json");
    m_toErrors = json != nullptr && json->count() > 0 && (json->results().empty() || json->results().front().empty());
    print("planned for " + name + "\n  reads: " + m_needs->reads + "\n  computes: " + m_needs->computes +
          "\n  networks: " + networksText(m_needs->networks) + "\n");
    m_inputs = namedPlaces(*command);
    auto watched = m_inputs;
    watched.push_back(rendering::models::shippedModel().parent_path());
    if (const auto cache = rendering::cache::usualFolder()) watched.push_back(*cache);
    m_opened = std::make_unique<protocols::OpenedFiles>(watched);
    m_librariesBefore = mappedLibraries();
    print("  libraries: " + std::to_string(m_librariesBefore.size()) + " of the program's start" +
          (*m_needs->libraries != '\0' ? std::string(", then ") + m_needs->libraries : "") + "\n");
    m_start = std::chrono::steady_clock::now();
}

void Explanation::end()
{
    if (m_needs == nullptr) return;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    std::string text = "found for the whole call\n  time: " + protocols::fixed(wall, 2) + " s; " + usageText(RUSAGE_SELF) + "\n";
    if (hadChildren()) text += "  programs that it started: " + usageText(RUSAGE_CHILDREN) + "\n";
    const auto& opened = m_opened->counts();
    const auto below = [&](const fs::path& place) {
        return static_cast<std::size_t>(
            std::count_if(opened.begin(), opened.end(), [&](const auto& file) { return liesBelow(file.first, place); }));
    };
    const std::string atLeast = m_opened->isComplete() ? "" : "at least ";
    for (const fs::path& place : m_inputs)
        text += "  files read of " + place.string() + ": " + atLeast + std::to_string(below(place)) + "\n";
    if (m_needs->networks != Networks::None)
        text += "  files read of the shipped weights: " + std::to_string(below(rendering::models::shippedModel().parent_path())) +
                "\n";
    if (const auto cache = rendering::cache::usualFolder())
        text += "  files read of the cache of signals: " + std::to_string(below(*cache)) + "\n";
    std::string added;
    std::size_t count = 0;
    const auto libraries = mappedLibraries();
    for (const auto& library : libraries)
        if (!m_librariesBefore.contains(library)) {
            added += (added.empty() ? "" : ", ") + library;
            ++count;
        }
    text += "  libraries: " + countText(libraries.size(), "is", "are") + " mapped into memory";
    text += count == 0 ? "\n" : "; " + countText(count, "was", "were") + " loaded while it ran: " + added + "\n";
    print(text);
}

void Explanation::print(const std::string& text) const
{
    std::fflush(stdout);
    std::fputs(text.c_str(), m_toErrors ? stderr : stdout);
    if (!m_toErrors) std::fflush(stdout);
}

void StageTimes::print(const std::string& text) const
{
    if (!m_isOn) return;
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

void StageTimes::begin(const std::string& name)
{
    const auto now = Clock::now();
    if (!m_stage.empty()) {
        const double milliseconds = std::chrono::duration<double, std::milli>(now - m_start).count();
        const auto known = std::find_if(m_times.begin(), m_times.end(), [&](const auto& one) { return one.first == m_stage; });
        if (known == m_times.end())
            m_times.emplace_back(m_stage, milliseconds);
        else
            known->second += milliseconds;
    }
    m_stage = name;
    m_start = now;
}

void StageTimes::end()
{
    begin("");
    print("found by its stages\n");
    for (const auto& [name, milliseconds] : m_times)
        print("  time of " + name + ": " + protocols::fixed(milliseconds, 1) + " ms\n");
}

bool isExplained(const CLI::App& command)
{
    const CLI::Option* option = command.get_option_no_throw("--explain");
    return option != nullptr && option->count() > 0;
}

}  // namespace study::commands
