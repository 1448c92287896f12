// Prints the table "What is promised" with numbers that it measures now. Without options it is the short form that ./test runs.
//   promises --long                    every row with the effort of the issue; some minutes
//   promises kills --kills 1000        one row
#include <CLI/CLI.hpp>
#include <QCoreApplication>
#include <cstdio>
#include <functional>

#include "protocols/files/errors.h"
#include "tests/promises/crash_states.h"
#include "tests/promises/disk_faults.h"
#include "tests/promises/durable_answer.h"
#include "tests/promises/erasure.h"
#include "tests/promises/kills.h"
#include "tests/promises/large_study.h"
#include "tests/promises/mid_session.h"

using namespace tests::promises;

namespace {

struct Row {
    const char* name;
    std::function<std::vector<Promise>(const Effort&)> measure;
};

const Row rows[] = {
    {"kills", [](const Effort& effort) { return std::vector{afterKills(effort)}; }},
    {"crash-states", [](const Effort& effort) { return std::vector{afterPowerCuts(effort)}; }},
    {"disk-faults", [](const Effort& effort) { return std::vector{afterDiskFaults(effort)}; }},
    {"mid-session", [](const Effort& effort) { return std::vector{afterMidSessionHarm(effort)}; }},
    {"erasure", [](const Effort& effort) { return std::vector{afterErasure(effort)}; }},
    {"large-study", ofLargeStudies},
    {"durable-answer", [](const Effort& effort) { return std::vector{ofDurableAnswers(effort)}; }},
};

constexpr Effort longForm{1000, 2000, 0, 0, 252000, 2520, true, {}};

}  // namespace

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);
    CLI::App app(
        "Measures what the README promises about stored answers, and prints the table. Exit code 1: a promise is broken.");
    Effort effort;
    bool isLong = false;
    std::string studies, made;
    std::vector<std::string> chosen, names;
    for (const Row& row : rows) names.emplace_back(row.name);
    app.add_option("ROW", chosen, "only these rows")->check(CLI::IsMember(names));
    app.add_flag("--long", isLong, "the effort of the table in the README; also decides about times. Use it on a quiet machine");
    app.add_option("--kills", effort.kills, "processes to kill");
    app.add_option("--crash-states", effort.crashStates, "states of the disk after a power cut");
    app.add_option("--positions", effort.faultPositions, "writes and syncs that fail; 0: every one of a session");
    app.add_option("--moments", effort.midSessionMoments, "answers after which a session is harmed; 0: every one");
    app.add_option("--answers", effort.answers, "answers of the large study, a multiple of 2,520");
    app.add_option("--durable", effort.durableAnswers, "answers to time");
    app.add_option("--studies", studies, "a folder that keeps the large studies for the next run");
    app.add_option("--make-study", made, "only make a study of so many --answers in this new folder");
    app.add_flag("--times", effort.decidesTimes, "times are limits, too");
    CLI11_PARSE(app, argc, argv);
    if (isLong) effort = longForm;
    effort.studies = studies;
    std::vector<Promise> promises;
    try {
        if (!made.empty()) {
            makeLargeStudy(made, effort.answers);
            return 0;
        }
        for (const Row& row : rows) {
            if (!chosen.empty() && std::ranges::find(chosen, row.name) == chosen.end()) continue;
            std::fprintf(stderr, "%s ...\n", row.name);
            for (Promise& promise : row.measure(effort)) promises.push_back(std::move(promise));
        }
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "promises: %s\n", fault.what());
        return 1;
    }
    std::printf("%s", tableOf(promises).c_str());
    return allHold(promises) ? 0 : 1;
}
