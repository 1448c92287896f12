#include "study/bench/extremes/extremes_page.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "protocols/files/markup_text.h"

namespace study::bench {

namespace {

using nlohmann::ordered_json;
using protocols::escapedMarkup;

const std::vector<std::string>& peerNames()
{
    static const std::vector<std::string> names{"R", "scipy", "scikit-image", "OpenCV"};
    return names;
}

std::string written(const char* format, double number)
{
    char text[40];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string digitsText(const ExtremeAnswer& answer, const ExtremeCase& asked)
{
    const auto digits = correctDigits(answer.decimal, asked.truth);
    return digits ? written("%.1f", *digits) : "";
}

std::string padded(std::string text, std::size_t width)
{
    return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

/// An answer of another program counts as wrong below half the digits that we promise.
bool isWrong(const PeerAnswer& peer, const ExtremeCase& asked) { return !isRight(peer.answer, asked, asked.leastDigits / 2); }

/// "scipy: 31 of 52 with at least half the digits promised here, or a refusal where there is no number."
std::string sentenceOn(const std::string& peer, const std::vector<ExtremeResult>& results)
{
    int asked = 0, right = 0;
    for (const ExtremeResult& one : results) {
        const auto found = one.peers.find(peer);
        if (found == one.peers.end()) continue;
        ++asked;
        right += isWrong(found->second, one.asked) ? 0 : 1;
    }
    if (asked == 0) return {};
    return peer + ": " + std::to_string(right) + " of the " + std::to_string(asked) +
           " cases that it has a function for, with at least half the digits promised here, or a refusal where there is no "
           "number.";
}

std::string sentenceOnUs(const std::vector<ExtremeResult>& results)
{
    const auto reached = std::count_if(results.begin(), results.end(), [](const auto& one) { return one.isReached(); });
    return "vis2hap: " + std::to_string(reached) + " of all " + std::to_string(results.size()) +
           " cases, with the digits promised here, or a refusal where there is no number.";
}

ordered_json jsonOf(const ExtremeAnswer& answer, const ExtremeCase& asked, double milliseconds)
{
    ordered_json json;
    json["answer"] = answer.decimal.empty() ? ordered_json() : ordered_json(answer.decimal);
    if (!answer.refusal.empty()) json["why"]["answer"] = answer.refusal;
    const auto digits = correctDigits(answer.decimal, asked.truth);
    json["digits"] = digits ? ordered_json(*digits) : ordered_json();
    if (!digits) json["why"]["digits"] = "there are no digits to compare";
    json["ms"] = milliseconds;
    return json;
}

std::string cellOf(const std::string& label, const ExtremeAnswer& answer, const ExtremeCase& asked, double milliseconds,
                   bool wrong)
{
    const std::string shown = answer.decimal.empty() ? "refused" : answer.decimal;
    return "<td data-label=\"" + escapedMarkup(label) + "\" class=\"" + (wrong ? "wrong" : "right") + "\" title=\"" +
           escapedMarkup(answer.refusal) + "\"><b>" + escapedMarkup(shown) + "</b><span>" +
           escapedMarkup(worthOf(answer, asked) + ", " + written("%.3g ms", milliseconds)) + "</span></td>";
}

std::string rowOf(const ExtremeResult& result)
{
    std::string row = "<tr><th scope=\"row\">" + escapedMarkup(result.asked.input) + "<span>" +
                      escapedMarkup(result.asked.asked) + "</span></th><td data-label=\"truth\"><b>" +
                      escapedMarkup(result.asked.truth) + "</b><span>" + escapedMarkup(result.asked.source) + "</span></td>" +
                      cellOf("vis2hap", result.ours, result.asked, result.milliseconds, !result.isReached());
    for (const std::string& peer : peerNames()) {
        const auto found = result.peers.find(peer);
        row += found == result.peers.end() ? "<td class=\"none\">–</td>"
                                           : cellOf(peer, found->second.answer, result.asked, found->second.milliseconds,
                                                    isWrong(found->second, result.asked));
    }
    return row + "</tr>\n";
}

constexpr const char* style =
    R"(:root{color-scheme:light dark;--ink:#1d2a33;--paper:#fff;--faint:#5b6770;--line:#d7dde2;--right:#e4f3ea;--wrong:#fbe3da}
@media (prefers-color-scheme:dark){:root{--ink:#e8edf1;--paper:#14191d;--faint:#a3afb9;--line:#39434b;--right:#173425;--wrong:#4a2418}}
body{font:16px/1.45 system-ui,sans-serif;color:var(--ink);background:var(--paper);margin:0 auto;padding:1rem;max-width:110rem}
table{border-collapse:collapse;width:100%;font-size:.85rem;margin-bottom:2rem}
th,td{border-bottom:1px solid var(--line);padding:.35rem .5rem;text-align:left;vertical-align:top;font-weight:400}
thead th{font-weight:600;border-bottom:2px solid var(--line)}tbody th{min-width:12rem}td b{font-weight:600;overflow-wrap:anywhere}
span{display:block;color:var(--faint);font-size:.9em}.right{background:var(--right)}.wrong{background:var(--wrong)}.none{color:var(--faint)}
@media (max-width:60rem){thead{display:none}table,tbody,tr,td,tbody th{display:block}tr{border:1px solid var(--line);border-radius:.5rem;margin:.75rem 0;padding:.25rem}
td,tbody th{border:0}tbody th{font-weight:600}.none{display:none}td[data-label]::before{content:attr(data-label);color:var(--faint);font-size:.8rem}})";

}  // namespace

std::string worthOf(const ExtremeAnswer& answer, const ExtremeCase& asked)
{
    if (asked.mustRefuse()) return answer.decimal.empty() ? "as it must" : "no number exists";
    const std::string digits = digitsText(answer, asked);
    return digits.empty() ? "no number" : digits + " digits";
}

std::string extremesText(const std::vector<ExtremeResult>& results)
{
    std::string text, room;
    for (const ExtremeResult& one : results) {
        if (one.asked.room != room) {
            room = one.asked.room;
            text += (text.empty() ? "" : "\n") + room + "\n";
        }
        const std::string shown = one.ours.decimal.empty() ? "refused" : one.ours.decimal;
        text += "  " + std::string(one.isReached() ? " " : "!") + " " + padded(one.asked.name(), 66) + " truth " +
                padded(one.asked.truth, 24) + " ours " + padded(shown, 24) + " " + padded(worthOf(one.ours, one.asked), 12) +
                written(" %9.3f ms", one.milliseconds);
        for (const auto& [peer, found] : one.peers)
            text += "; " + peer + " " + (found.answer.decimal.empty() ? "refused" : found.answer.decimal) + " (" +
                    worthOf(found.answer, one.asked) + ")";
        text += "\n      " + one.asked.source + "\n";
    }
    text += "\n" + sentenceOnUs(results) + "\n";
    for (const std::string& peer : peerNames())
        if (const std::string sentence = sentenceOn(peer, results); !sentence.empty()) text += sentence + "\n";
    return text;
}

ordered_json extremesJson(const std::vector<ExtremeResult>& results, const std::string& machine)
{
    ordered_json json{{"schema", "vis2hap.extremes/1"}, {"machine", machine}, {"cases", ordered_json::array()}};
    for (const ExtremeResult& one : results) {
        ordered_json line{{"room", one.asked.room},   {"input", one.asked.input},   {"asked", one.asked.asked},
                          {"truth", one.asked.truth}, {"source", one.asked.source}, {"promised_digits", one.asked.leastDigits}};
        line["ours"] = jsonOf(one.ours, one.asked, one.milliseconds);
        line["reached"] = one.isReached();
        for (const auto& [peer, found] : one.peers) line["peers"][peer] = jsonOf(found.answer, one.asked, found.milliseconds);
        json["cases"].push_back(line);
    }
    return json;
}

std::string extremesPage(const std::vector<ExtremeResult>& results, const std::string& machine, bool peers)
{
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
        "<title>Extreme inputs</title><style>" +
        std::string(style) +
        "</style></head>\n<body><h1>Extreme inputs</h1>\n<p>Every line is an input at the edge of "
        "what numbers or rooms allow, with its known result. Digits: how many leading digits are correct. Measured on " +
        escapedMarkup(machine) + ". Printed by <code>vis2hap bench extremes" + (peers ? " --peers" : "") +
        " --page FILE</code>.</p>\n<ul><li>" + escapedMarkup(sentenceOnUs(results)) + "</li>";
    for (const std::string& peer : peerNames()) {
        const std::string sentence = sentenceOn(peer, results);
        if (!sentence.empty())
            page += "<li>" + escapedMarkup(sentence) + "</li>";
        else if (peers)
            page += "<li>" + peer + " is not installed on this machine.</li>";
    }
    page += "</ul>\n";
    std::string room;
    for (const ExtremeResult& one : results) {
        if (one.asked.room != room) {
            page += room.empty() ? "" : "</tbody></table>\n";
            room = one.asked.room;
            page += "<h2>" + escapedMarkup(room) + "</h2>\n<table><thead><tr><th>input</th><th>truth</th><th>vis2hap</th>";
            for (const std::string& peer : peerNames()) page += "<th>" + peer + "</th>";
            page += "</tr></thead><tbody>\n";
        }
        page += rowOf(one);
    }
    return page + (room.empty() ? "" : "</tbody></table>\n") + "</body></html>\n";
}

}  // namespace study::bench
