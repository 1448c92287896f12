#include "study/bench/bench_row.h"

#include <algorithm>
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

std::string inWords(const RatioPromise& promise)
{
    const std::string limit = "promised: at most " + written(promise.most, "%.2f") + " x " + promise.peer;
    return promise.ratio ? limit + ", " + written(promise.ratio, "%.3f") + (promise.isMet() ? " (met)" : " (NOT met)")
                         : limit + ", not measured";
}

/// The note, with the times of the peers and the promise behind it.
std::string noteOf(const BenchRow& row)
{
    std::string note = row.note;
    const auto add = [&note](const std::string& part) { note += (note.empty() ? "" : ", ") + part; };
    for (const auto& [peer, milliseconds] : row.peers) {
        add(peer + " " + (milliseconds ? written(milliseconds, "%.1f ms") : "not installed"));
        const auto differs = row.peersDiffer.find(peer);
        if (differs != row.peersDiffer.end()) note += " (answer differs by " + written(differs->second, "%.1e") + ")";
    }
    if (row.promise) add(inWords(*row.promise));
    return note;
}

/// "12.345" and "±0.1", where the row was repeated.
std::string timeOf(const BenchRow& row)
{
    std::string time = written(row.milliseconds, "%.3f");
    if (row.quartiles) time += " ±" + written((row.quartiles->high - row.quartiles->low) / 2, "%.2g");
    return time;
}

/// Pads to a width in characters; "±" is one character of two bytes.
std::string padded(const std::string& text, std::size_t width)
{
    const auto characters = static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
    return characters < width ? std::string(width - characters, ' ') + text : text;
}

std::string lineOf(const BenchRow& row)
{
    const std::string note = noteOf(row);
    char names[120];
    std::snprintf(names, sizeof names, "%-34s %c %-15s", row.stage.c_str(), row.onFront ? '*' : ' ', row.quality.c_str());
    return names + padded(timeOf(row), 17) + padded(written(row.megabytes, "%.1f"), 8) + padded(written(row.error, "%.4g"), 12) +
           "  " + row.errorUnit + (row.errorUnit.empty() || note.empty() ? "" : "; ") + note + "\n";
}

bool isTimed(const BenchRow& row) { return row.milliseconds && row.error && *row.milliseconds > 0; }

bool beats(const BenchRow& a, const BenchRow& b)
{
    return *a.milliseconds <= *b.milliseconds && *a.error <= *b.error &&
           (*a.milliseconds < *b.milliseconds || *a.error < *b.error);
}

}  // namespace

void markFronts(std::vector<BenchRow>& rows)
{
    for (BenchRow& row : rows) {
        if (!isTimed(row)) continue;
        const auto isRival = [&row](const BenchRow& other) {
            return &other != &row && other.stage == row.stage && other.errorUnit == row.errorUnit && isTimed(other);
        };
        const bool hasRivals = std::any_of(rows.begin(), rows.end(), isRival);
        row.onFront = hasRivals && std::none_of(rows.begin(), rows.end(),
                                                [&](const BenchRow& other) { return isRival(other) && beats(other, row); });
    }
}

std::optional<double> spreadPercent(const std::vector<BenchRow>& rows)
{
    std::vector<double> spreads;
    for (const BenchRow& row : rows)
        if (row.quartiles && row.milliseconds && *row.milliseconds > 0)
            spreads.push_back(50 * (row.quartiles->high - row.quartiles->low) / *row.milliseconds);
    if (spreads.empty()) return std::nullopt;
    const auto middle = spreads.begin() + static_cast<std::ptrdiff_t>(spreads.size() / 2);
    std::nth_element(spreads.begin(), middle, spreads.end());
    return *middle;
}

ordered_json jsonOf(const BenchRow& row)
{
    ordered_json json{{"stage", row.stage},
                      {"quality", row.quality},
                      {"ms", numberOrNull(row.milliseconds)},
                      {"error", numberOrNull(row.error)},
                      {"error_is", row.errorUnit},
                      {"note", noteOf(row)}};
    if (!row.milliseconds) json["why"]["ms"] = "this row has no time of its own";
    if (!row.error) json["why"]["error"] = "this row has no known result to compare with";
    for (const auto& [peer, milliseconds] : row.peers) {
        json["peers"][peer] = numberOrNull(milliseconds);
        if (!milliseconds) json["why"]["peers"] = "a peer without a number is not installed, or --peers was not given";
    }
    for (const auto& [peer, difference] : row.peersDiffer) json["peers_differ"][peer] = difference;
    if (row.quartiles) json["ms_quartiles"] = {row.quartiles->low, row.quartiles->high};
    if (row.megabytes) json["mb"] = *row.megabytes;
    json["on_front"] = row.onFront;
    if (row.promise) {
        json["promise"] = {{"peer", row.promise->peer}, {"at_most", row.promise->most}};
        json["promise"]["ratio"] = numberOrNull(row.promise->ratio);
        json["promise"]["met"] = row.promise->ratio ? ordered_json(row.promise->isMet()) : ordered_json();
        if (!row.promise->ratio) {
            constexpr const char* why = "the peer has no time here";
            json["promise"]["why"] = {{"ratio", why}, {"met", why}};
        }
    }
    return json;
}

std::string tableOf(const std::vector<BenchRow>& rows)
{
    char head[160];
    std::snprintf(head, sizeof head, "%-34s   %-15s%17s%8s%12s  %s\n", "stage", "setting", "ms", "MB", "error", "error is");
    std::string table = head;
    for (const BenchRow& row : rows) table += lineOf(row);
    return table;
}

}  // namespace study::bench
