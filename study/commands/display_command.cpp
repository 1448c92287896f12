// vis2hap display check SPEC; vis2hap display calibrate TABLE; vis2hap display serve ADDRESS
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/utf8.h"
#include "rendering/display/display_check.h"
#include "rendering/response/response_file.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/display_calibration.h"
#include "study/commands/parts/number_checks.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/server/display_relay.h"

namespace study::commands {

namespace {

struct CheckCall {
    std::string specification, response;
    double touchSeconds = 0;
};

void printDemand(const rendering::DisplayDemand& demand)
{
    const bool isMet = demand.fault.empty();
    std::printf("%s  %s%s%s\n", isMet ? "pass" : "FAIL", demand.demand.c_str(), isMet ? "" : ": ",
                protocols::printable(demand.fault).c_str());
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

/// A response holds for one display, which is known by its name.
std::string faultOfResponse(const CheckCall& call, const std::string& display)
{
    if (call.response.empty()) return {};
    const std::string measured = rendering::readResponse(call.response).setting.display;
    return measured == display ? "" : "it was measured on \"" + measured + "\", and this is \"" + display + "\"";
}

int checkDriver(const CheckCall& call)
{
    if (!call.response.empty()) (void)rendering::readResponse(call.response);  // refused before the display is used
    const auto address = rendering::driverAddressFrom(call.specification);
    if (!address)
        throw protocols::badInput({"display '" + call.specification + "' has no driver to check", "SPEC",
                                   "exec:COMMAND or tcp:HOST:PORT", "name the driver of the display"});
    rendering::DisplayCheckOptions options;
    options.touchWithin = std::chrono::milliseconds(static_cast<long>(1000 * call.touchSeconds));
    if (call.touchSeconds > 0)
        std::printf("Touch the display as soon as you feel that it is on. You have %g seconds.\n", call.touchSeconds);
    const auto result = checkDisplay(*address, options, printDemand);
    const std::string otherDisplay = faultOfResponse(call, result.name);
    if (!call.response.empty()) printDemand({"its response was measured on this display", otherDisplay});
    printTimes("show an image", result.showMs);
    printTimes("clear the display", result.clearMs);
    constexpr std::size_t longestName = 200;
    const std::string name =
        protocols::printable(protocols::inShort(result.name.empty() ? call.specification : result.name, longestName));
    const int faults = result.faults() + (otherDisplay.empty() ? 0 : 1);
    std::printf("%s: %s\n", name.c_str(),
                faults == 0 ? "meets every requirement" : reports::counted(static_cast<std::size_t>(faults), "fault").c_str());
    return static_cast<int>(faults == 0 ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

std::string localDate()
{
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char text[11];
    std::strftime(text, sizeof text, "%F", &local);
    return text;
}

CLI::Validator isDate()
{
    return CLI::Validator(
        [](std::string& text) {
            std::tm date{};
            const char* end = strptime(text.c_str(), "%Y-%m-%d", &date);
            return end != nullptr && *end == '\0' && text.size() == 10 ? std::string()
                                                                       : text + " is no date (expected YYYY-MM-DD)";
        },
        "YYYY-MM-DD");
}

void addCalibration(CLI::App& display, Action& action)
{
    auto* command =
        display.add_subcommand("calibrate", "fit the response of a display: friction measured at several grey levels");
    auto call = std::make_shared<DisplayCalibration>();
    call->setting.date = localDate();
    command->add_option("TABLE", call->table, "table of measurements in their order: grey level, friction coefficient or force")
        ->required();
    command->add_option("--out", call->out, "response.json to write")->required();
    command->add_option("--display", call->setting.display, "name of the display, as its driver states it")
        ->required()
        ->check(isName());
    command->add_option("--load", call->loadN, "normal force of the finger in newtons, where the table has no column load_n")
        ->check(aboveZero());
    command->add_option("--speed", call->setting.speedMmPerS, "speed of the finger in mm/s")->required()->check(aboveZero());
    command->add_option("--finger", call->setting.finger, "what slid over the glass, e.g. \"index finger, dry\"")
        ->required()
        ->check(isName());
    command->add_option("--date", call->setting.date, "day of the measurement, YYYY-MM-DD (default: today)")->check(isDate());
    command->add_option("--map", call->map,
                        "MEANING=COLUMN where a column has another name; level, friction, force, load, sweep");
    command->add_option("--picture", call->picture, "SVG file to draw the response to");
    command->callback([call, &action] { action.work = [call] { return calibrateDisplay(*call); }; });
}

struct ServeCall {
    std::string address, specification;
    int port = 5417;
};

void addServing(CLI::App& display, Action& action)
{
    auto* command = display.add_subcommand(
        "serve", "fetch images from a server for a station that gets tickets; run it under an account of its own");
    auto call = std::make_shared<ServeCall>();
    command->add_option("ADDRESS", call->address, "postgresql://LOGIN@HOST/DATABASE?study=NAME, LOGIN with the role display")
        ->required();
    command->add_option("--display", call->specification, "the device's own driver: exec:COMMAND or tcp:HOST:PORT")->required();
    command->add_option("--port", call->port, "port of this computer for the station")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return serveDisplay(call->address, call->specification, call->port); };
    });
}

}  // namespace

void addDisplay(CLI::App& app, Action& action)
{
    auto* display = app.add_subcommand(
        "display", "check the driver of a haptic display, fit its response, or fetch its images from a server");
    display->require_subcommand(1);
    auto* command = display->add_subcommand(
        "check", "test every requirement of the driver protocol: pass or FAIL; the display shows images meanwhile");
    auto call = std::make_shared<CheckCall>();
    command->add_option("SPEC", call->specification, "exec:COMMAND or tcp:HOST:PORT, as for vis2hap --display")->required();
    command->add_option("--touch", call->touchSeconds, "seconds to wait for a finger, to check that the driver reports touches")
        ->check(finiteIn(0, 600));
    command->add_option("--response", call->response, "response.json, to check that it belongs to this display");
    command->callback([call, &action] { action.work = [call] { return checkDriver(*call); }; });
    addCalibration(*display, action);
    addServing(*display, action);
}

}  // namespace study::commands
