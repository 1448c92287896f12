#include "study/participant/page_room.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/usual_texts.h"

namespace study::participant {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view cookieName = "vis2hap";
constexpr const char* jsonType = "application/json";

/// Sent with every reply: nothing is kept, nothing else is loaded, nobody may put the page into a frame.
const std::vector<std::pair<std::string, std::string>>& strictHeaders()
{
    static const std::vector<std::pair<std::string, std::string>> headers{
        {"Cache-Control", "no-store"},
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; base-uri 'none'; "
         "form-action 'none'; frame-ancestors 'none'"},
        {"X-Content-Type-Options", "nosniff"},
        {"X-Frame-Options", "DENY"},
        {"Referrer-Policy", "no-referrer"},
        {"Cross-Origin-Resource-Policy", "same-origin"}};
    return headers;
}

std::string textOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

PageReply plain(int status, std::string contentType, std::string body)
{
    return {status, std::move(contentType), std::move(body), {}, {}};
}

/// A refusal for programs; a person at the page sees the texts of refusal().
PageReply bare(int status, const char* why) { return plain(status, "text/plain; charset=utf-8", std::string(why) + "\n"); }

bool isJson(std::string_view contentType) { return contentType == jsonType || contentType.starts_with("application/json;"); }

}  // namespace

PageRoom::PageRoom(std::string host, PageFiles files, PageAccess access)
    : m_host(std::move(host)), m_files(std::move(files)), m_access(std::move(access)), m_texts{"en", {}}
{
    m_texts.texts.insert(protocols::usualParticipantTexts().begin(), protocols::usualParticipantTexts().end());
    nameWords();
}

void PageRoom::nameWords()
{
    constexpr std::size_t letters = 16;
    m_wordsName = protocols::sha256(textOf({m_texts.language, m_texts.texts})).substr(0, letters);
    // Letters only: no reader of the page should take digits for the code of a piece.
    for (char& letter : m_wordsName)
        if (letter <= '9') letter = static_cast<char>('g' + (letter - '0'));
}

void PageRoom::take(const LineToPage& line, std::int64_t nowNs)
{
    std::visit(protocols::Overloaded{[this](const NewCode& code) { m_access.setCode(code.code); },
                                     [this](const KnownDevice& device) { m_access.restore(device.sessionHash); },
                                     [this](const PageTexts& texts) {
                                         m_texts.language = texts.language;
                                         for (const auto& [key, text] : texts.texts) m_texts.texts[key] = text;
                                         nameWords();
                                     },
                                     [&](const NumberedInstruction& present) {
                                         m_present = present;
                                         m_presentSinceNs = nowNs;
                                     }},
               line);
}

PageReply PageRoom::answer(const PageRequest& request, std::int64_t nowNs)
{
    PageReply reply = routed(request, nowNs);
    reply.headers.insert(reply.headers.end(), strictHeaders().begin(), strictHeaders().end());
    return reply;
}

PageReply PageRoom::routed(const PageRequest& request, std::int64_t nowNs)
{
    struct Place {
        std::string_view path, method;
        std::size_t longestBody = 0;
    };
    static constexpr Place places[] = {{"/", "GET"},
                                       {"/page.css", "GET"},
                                       {"/page.js", "GET"},
                                       {"/words", "GET"},
                                       {"/now", "GET"},
                                       {"/enter", "POST", longestEntry},
                                       {"/act", "POST", longestBody}};
    // A page of another name that leads to this address must not read it (DNS rebinding).
    if (request.host != m_host) return bare(421, "this address is not served here");
    if (!request.origin.empty() && request.origin != "http://" + m_host) return bare(403, "another page sent this");
    if (request.path.size() > longestPath) return bare(414, "this path is too long");
    const auto place = std::ranges::find(places, std::string_view(request.path), &Place::path);
    if (place == std::end(places)) return bare(404, "there is nothing here");
    if (place->method != request.method) {
        PageReply reply = bare(405, "this method is not known here");
        reply.headers.emplace_back("Allow", place->method);
        return reply;
    }
    if (request.body.size() > place->longestBody) return bare(413, "this body is too large");
    if (place->method == "POST" && !isJson(request.contentType)) return bare(415, "only application/json is read");
    if (request.path == "/") return plain(200, "text/html; charset=utf-8", m_files.html);
    if (request.path == "/page.css") return plain(200, "text/css; charset=utf-8", m_files.css);
    if (request.path == "/page.js") return plain(200, "text/javascript; charset=utf-8", m_files.script);
    if (request.path == "/words") return words();
    if (request.path == "/enter") return enter(request, nowNs);
    if (!isIn(request)) return refusal(401, m_access.hasDevice() ? "code_taken" : "code_text");
    return request.path == "/now" ? present(nowNs) : act(request);
}

bool PageRoom::isIn(const PageRequest& request) const { return m_access.isIn(cookieIn(request.cookie, cookieName)); }

PageReply PageRoom::refusal(int status, std::string_view key, std::chrono::seconds wait) const
{
    const auto found = m_texts.texts.find(std::string(key));
    std::string text = found == m_texts.texts.end() ? std::string(key) : found->second;
    const std::string seconds = std::to_string(wait.count());
    if (const auto at = text.find("{seconds}"); at != std::string::npos) text.replace(at, 9, seconds);
    PageReply reply = plain(status, jsonType, textOf({{"why", text}, {"words", m_wordsName}}));
    if (wait.count() > 0) reply.headers.emplace_back("Retry-After", seconds);
    return reply;
}

PageReply PageRoom::words() const
{
    return plain(200, jsonType, textOf({{"name", m_wordsName}, {"language", m_texts.language}, {"texts", m_texts.texts}}));
}

PageReply PageRoom::enter(const PageRequest& request, std::int64_t nowNs)
{
    std::string code;
    try {
        const auto body = protocols::parseStrictJson(request.body, "the body");
        if (!body.is_object() || body.size() != 1 || !body.contains("code") || !body.at("code").is_string())
            return bare(400, R"(expected {"code": "…"})");
        code = body.at("code").get<std::string>();
    } catch (const protocols::Error&) {
        return bare(400, R"(expected {"code": "…"})");
    }
    using Why = PageAccess::Refused::Why;
    const int wrongBefore = m_access.wrongCodes();
    const auto outcome = m_access.enter(code, nowNs);
    if (const auto* entered = std::get_if<PageAccess::Entered>(&outcome)) {
        PageReply reply = plain(204, "", "");
        reply.headers.emplace_back("Set-Cookie",
                                   std::string(cookieName) + "=" + entered->secret + "; Path=/; HttpOnly; SameSite=Strict");
        reply.lines.emplace_back(DeviceEntered{request.from, entered->sessionHash});
        return reply;
    }
    const auto& refused = std::get<PageAccess::Refused>(outcome);
    PageReply reply = refused.why == Why::WrongCode    ? refusal(403, "code_wrong")
                      : refused.why == Why::Wait       ? refusal(429, "code_wait", refused.wait)
                      : refused.why == Why::CodeIsVoid ? refusal(403, "code_spent")
                                                       : refusal(409, "code_taken");
    if (refused.why == Why::AnotherDevice) reply.lines.emplace_back(DeviceRefused{request.from});
    if (m_access.wrongCodes() > wrongBefore)
        reply.lines.emplace_back(WrongCodeEntered{request.from, m_access.wrongCodes(), refused.why == Why::CodeIsVoid});
    return reply;
}

PageReply PageRoom::present(std::int64_t nowNs) const
{
    Instruction instruction = m_present.instruction;
    if (instruction.breakSeconds) *instruction.breakSeconds += static_cast<int>((nowNs - m_presentSinceNs) / 1'000'000'000);
    Json json{{"number", m_present.number}, {"words", m_wordsName}};
    json["instruction"] = Json::parse(jsonOf(instruction));
    return plain(200, jsonType, textOf(json));
}

PageReply PageRoom::act(const PageRequest& request) const
{
    ParticipantAct act;
    try {
        act = actFromJson(request.body, "the body");
    } catch (const protocols::Error&) {
        return bare(400, "this is no act of a participant");
    }
    if (act.number != m_present.number) return bare(409, "the page shows something else by now");
    if (!isAskedFor(act, m_present.instruction)) return bare(400, "the page does not ask for this");
    PageReply reply = plain(204, "", "");
    reply.lines.emplace_back(std::move(act));
    return reply;
}

std::string cookieIn(std::string_view header, std::string_view name)
{
    while (!header.empty()) {
        std::string_view one = header.substr(0, header.find(';'));
        header.remove_prefix(std::min(header.size(), one.size() + 1));
        one.remove_prefix(std::min(one.size(), one.find_first_not_of(' ')));
        if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=')
            return std::string(one.substr(name.size() + 1));
    }
    return {};
}

}  // namespace study::participant
