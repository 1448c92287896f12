#include "study/bench/extremes/extreme_peers.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "protocols/files/number_text.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "study/bench/peer_programs.h"

namespace study::bench {

namespace {

/// "0x1.8p+1"; the peers read "nan", "inf" and "-inf".
std::string hexadecimal(double number)
{
    char text[40];
    std::snprintf(text, sizeof text, "%a", number);
    return text;
}

/// One line a case: number, operation, then a field of blank-separated numbers for each row. Tabs part the fields.
std::string requestsOf(const std::vector<ExtremeResult>& results)
{
    std::string text;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const PeerRequest& request = results[i].asked.peer;
        if (request.operation.empty()) continue;
        text += std::to_string(i) + "\t" + request.operation;
        for (const auto& row : request.rows) {
            text += "\t";
            for (const double number : row) text += hexadecimal(number) + " ";
        }
        text += "\n";
    }
    return text;
}

/// Adds lines of "number TAB peer TAB number|refused TAB text TAB milliseconds".
void addAnswers(std::vector<ExtremeResult>& results, const std::string& output)
{
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> fields;
        std::istringstream parts(line);
        for (std::string field; std::getline(parts, field, '\t');) fields.push_back(field);
        if (fields.size() != 5) continue;
        const auto number = protocols::numberIn(fields[0]);
        if (!number || *number < 0 || *number >= static_cast<double>(results.size())) continue;
        PeerAnswer& answer = results[static_cast<std::size_t>(*number)].peers[fields[1]];
        (fields[2] == "number" ? answer.answer.decimal : answer.answer.refusal) = fields[3];
        answer.milliseconds = protocols::numberIn(fields[4]).value_or(0);
    }
}

}  // namespace

void addPeerAnswers(std::vector<ExtremeResult>& results)
{
    const protocols::TemporaryFolder folder;
    const auto requests = folder.path() / "requests.txt";
    protocols::writeWholeFile(requests, requestsOf(results), protocols::Sync::Later);
    addAnswers(results, outputOfPeer({"/usr/bin/python3", "-B", peerScript("extremes_peer.py"), requests.string()}));
    addAnswers(results, outputOfPeer({"Rscript", peerScript("extremes_peer.R"), requests.string()}));
}

}  // namespace study::bench
