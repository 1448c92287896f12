// vis2hap display check SPEC
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "rendering/display/display_check.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/number_checks.h"

namespace study::commands {

namespace {

struct CheckCall {
    std::string specification;
    double touchSeconds = 0;
};

void printDemand(const rendering::DisplayDemand& demand)
{
    const bool isMet = demand.fault.empty();
    std::printf("%s  %s%s%s\n", isMet ? "pass" : "FAIL", demand.demand.c_str(), isMet ? "" : ": ", demand.fault.c_str());
    std::fflush(stdout);
}

void printTimes(const char* what, std::vector<double> milliseconds)
{
    if (milliseconds.empty()) return;
    std::sort(milliseconds.begin(), milliseconds.end());
    const std::size_t half = milliseconds.size() / 2;
    const double median = milliseconds.size() % 2 == 1 ? milliseconds[half] : (milliseconds[half - 1] + milliseconds[half]) / 2;
    std::printf("%s: median %.1f ms of %zu, longest %.1f ms\n", what, median, milliseconds.size(), milliseconds.back());
}

int checkDriver(const CheckCall& call)
{
    const auto address = rendering::driverAddressFrom(call.specification);
    if (!address)
        throw protocols::badInput({"display '" + call.specification + "' has no driver to check", "SPEC",
                                   "exec:COMMAND or tcp:HOST:PORT", "name the driver of the display"});
    rendering::DisplayCheckOptions options;
    options.touchWithin = std::chrono::milliseconds(static_cast<long>(1000 * call.touchSeconds));
    if (call.touchSeconds > 0)
        std::printf("Touch the display as soon as you feel that it is on. You have %g seconds.\n", call.touchSeconds);
    const auto result = checkDisplay(*address, options, printDemand);
    printTimes("show an image", result.showMs);
    printTimes("clear the display", result.clearMs);
    const std::string name = result.name.empty() ? call.specification : result.name;
    const int faults = result.faults();
    std::printf("%s: %s\n", name.c_str(),
                faults == 0 ? "meets every requirement" : reports::counted(static_cast<std::size_t>(faults), "fault").c_str());
    return static_cast<int>(faults == 0 ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

}  // namespace

void addDisplay(CLI::App& app, Action& action)
{
    auto* display = app.add_subcommand("display", "check the driver of a haptic display");
    display->require_subcommand(1);
    auto* command = display->add_subcommand(
        "check", "test every requirement of the driver protocol: pass or FAIL; the display shows images meanwhile");
    auto call = std::make_shared<CheckCall>();
    command->add_option("SPEC", call->specification, "exec:COMMAND or tcp:HOST:PORT, as for vis2hap --display")->required();
    command->add_option("--touch", call->touchSeconds, "seconds to wait for a finger, to check that the driver reports touches")
        ->check(finiteIn(0, 600));
    command->callback([call, &action] { action.work = [call] { return checkDriver(*call); }; });
}

}  // namespace study::commands
