#include "study/bench/bench_row.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace study::bench {

namespace {

using nlohmann::ordered_json;

ordered_json numberOrNull(const std::optional<double>& number) { return number ? ordered_json(*number) : ordered_json(); }

std::string written(const std::optional<double>& number, const char* format)
{
    char text[40] = "";
    if (number) std::snprintf(text, sizeof text, format, *number);
    return text;
}

/// The note, with the times of the peers behind it.
std::string noteOf(const BenchRow& row)
{
    std::string note = row.note;
    for (const auto& [peer, milliseconds] : row.peers)
        note += ", " + peer + " " + (milliseconds ? written(milliseconds, "%.1f ms") : "not installed");
    return note;
}

std::string lineOf(const BenchRow& row)
{
    const std::string note = noteOf(row);
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, "%-34s %-10s %10s %12s  ", row.stage.c_str(), row.quality.c_str(),
                  written(row.milliseconds, "%.3f").c_str(), written(row.error, "%.4g").c_str());
    return numbers + row.errorUnit + (row.errorUnit.empty() || note.empty() ? "" : "; ") + note + "\n";
}

}  // namespace

ordered_json jsonOf(const BenchRow& row)
{
    ordered_json json{{"stage", row.stage},
                      {"quality", row.quality},
                      {"ms", numberOrNull(row.milliseconds)},
                      {"error", numberOrNull(row.error)},
                      {"error_is", row.errorUnit},
                      {"note", noteOf(row)}};
    for (const auto& [peer, milliseconds] : row.peers) json["peers"][peer] = numberOrNull(milliseconds);
    return json;
}

std::string tableOf(const std::vector<BenchRow>& rows)
{
    char head[160];
    std::snprintf(head, sizeof head, "%-34s %-10s %10s %12s  %s\n", "stage", "quality", "ms", "error", "error is");
    std::string table = head;
    for (const BenchRow& row : rows) table += lineOf(row);
    return table;
}

}  // namespace study::bench
