#include "study/commands/parts/display_calibration.h"

#include <cstdio>
#include <filesystem>
#include <map>

#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "rendering/response/response_drawing.h"
#include "rendering/response/response_file.h"
#include "rendering/response/response_table.h"
#include "study/commands/parts/pair_options.h"

namespace study::commands {

namespace {

std::string cellOr(const std::optional<double>& value) { return value ? protocols::fixed(*value, 4) : "-"; }

void printResponse(const rendering::DisplayResponse& response)
{
    std::printf("%5s %4s %9s %9s %9s %9s %9s\n", "level", "n", "mean", "+/- 95 %", "curve", "rising", "falling");
    for (const auto& level : response.measured)
        std::printf("%5d %4d %9.4f %9s %9.4f %9s %9s\n", level.level, level.count, level.mean, cellOr(level.halfWidth).c_str(),
                    level.fitted, cellOr(level.up).c_str(), cellOr(level.down).c_str());
    std::printf("friction from %.4f to %.4f, a factor of %.2f\n", response.friction.front(), response.friction.back(),
                response.friction.front() > 0 ? response.friction.back() / response.friction.front() : 0.0);
    std::printf("usable levels: %d to %d (friction up to level %d is that of level %d; from level %d on it does not grow)\n",
                response.deadUpTo, response.saturatedFrom, response.deadUpTo, response.lowestLevel(), response.saturatedFrom);
    if (response.noise) std::printf("one measurement scatters by %.4f\n", *response.noise);
    if (response.hysteresis) std::printf("rising and falling levels differ by %.4f\n", *response.hysteresis);
    for (const auto& remark : remarksOn(response)) std::printf("note: %s\n", remark.c_str());
}

}  // namespace

int calibrateDisplay(const DisplayCalibration& call)
{
    std::map<std::string, std::string> columns;
    for (const std::string& pair : call.map) columns.insert(wordsAround(pair, '=', "--map", "level=Grauwert"));
    const auto table = rendering::readResponseTable(call.table, columns, call.loadN);
    if (!table.taken.empty())
        std::fprintf(stderr, "note: %s is read as %s\n", protocols::printable(call.table).c_str(),
                     protocols::printable(table.taken).c_str());
    rendering::DisplayResponse response = fitResponse(table.measurements, call.table);
    response.setting = call.setting;
    response.setting.loadN = table.loadN;
    response.source = std::filesystem::path(call.table).filename().string();
    response.sourceSha256 = protocols::sha256OfFile(call.table);
    const std::string json = responseJson(response);
    response = rendering::responseFromJson(json, call.out);  // no file is written that study new would refuse
    if (!call.picture.empty()) protocols::requireWritable(call.picture);
    protocols::writeWholeFile(call.out, json);
    if (!call.picture.empty()) protocols::writeWholeFile(call.picture, responseDrawing(response));
    printResponse(response);
    std::printf("%s: %s\n", protocols::printable(call.out).c_str(), protocols::printable(measuredText(response.setting)).c_str());
    std::printf(
        "next: `vis2hap study new STUDY --dataset DATASET --response %s` makes equal steps of a map equal steps of friction\n",
        protocols::shellWord(call.out).c_str());
    return 0;
}

}  // namespace study::commands
