// Answers the requests of browsers to the participant's page. Holds no socket and no clock, and knows nothing but the texts of
// the page and the present instruction. What is not asked for exactly is refused: other hosts, paths, methods, types and sizes.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study/participant/page_access.h"
#include "study/participant/page_lines.h"

namespace study::participant {

inline constexpr std::size_t longestBody = 1 << 16;  ///< of an act, bytes
inline constexpr std::size_t longestEntry = 256;     ///< body with a code, bytes: anybody in the network may send one
inline constexpr std::size_t longestPath = 200;

/// A request as it came; missing headers are empty.
struct PageRequest {
    std::string method = {};  ///< "GET"
    std::string path = {};    ///< with the query, as it came
    std::string host = {}, origin = {}, cookie = {}, contentType = {};
    std::string body = {};
    std::string from = {};  ///< address of the browser
};

struct PageReply {
    int status = 200;
    std::string contentType;
    std::string body;
    std::vector<std::pair<std::string, std::string>> headers;
    std::vector<LineFromPage> lines;  ///< for the app
};

/// The files of the page, built into the program.
struct PageFiles {
    std::string html, css, script;
};

class PageRoom {
public:
    /// `host`: the address and port that browsers must name, as in "192.168.1.5:8577".
    PageRoom(std::string host, PageFiles files, PageAccess access);

    /// `nowNs`: any monotonic clock, the same in both.
    void take(const LineToPage& line, std::int64_t nowNs);
    /// Never throws for a bad request.
    PageReply answer(const PageRequest& request, std::int64_t nowNs);

private:
    PageReply enter(const PageRequest& request, std::int64_t nowNs);
    PageReply present(std::int64_t nowNs) const;
    PageReply act(const PageRequest& request) const;
    PageReply words() const;
    void nameWords();
    PageReply routed(const PageRequest& request, std::int64_t nowNs);
    bool isIn(const PageRequest& request) const;
    PageReply refusal(int status, std::string_view key, std::chrono::seconds wait = {}) const;

    std::string m_host;
    PageFiles m_files;
    PageAccess m_access;
    PageTexts m_texts;
    std::string m_wordsName;  ///< other words have another one, also after a restart of the program
    NumberedInstruction m_present;
    std::int64_t m_presentSinceNs = 0;
};

/// The value of a cookie in a header of cookies; empty if it is not there.
std::string cookieIn(std::string_view header, std::string_view name);

}  // namespace study::participant
