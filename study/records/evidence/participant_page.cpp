#include "study/records/evidence/participant_page.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "database/evidence/acts.h"
#include "protocols/files/number_text.h"
#include "protocols/usual_texts.h"
#include "study/records/evidence/printed_page.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

std::string fieldText(const ordered_json& row, const char* key)
{
    if (!row.contains(key) || row[key].is_null()) return "";
    const auto& value = row[key];
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return protocols::shortest(value.get<double>());
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// "2026-11-22 14:03:11 UTC", or "2026-11-22 15:03:11 (UTC+01:00)", for an ISO 8601 time: a reader needs no milliseconds.
std::string readableTime(const ordered_json& row, const char* key = "time")
{
    const std::string whole = fieldText(row, key);
    std::string time = whole.substr(0, 19);
    if (time.size() == 19 && time[10] == 'T') time[10] = ' ';
    if (whole.ends_with('Z') || whole.ends_with("+00:00")) return time + " UTC";
    constexpr std::size_t offsetLength = 6;  // +01:00
    const std::string offset = whole.size() > 19 + offsetLength ? whole.substr(whole.size() - offsetLength) : "";
    const bool isOffset = !offset.empty() && (offset[0] == '+' || offset[0] == '-') && offset[3] == ':';
    return isOffset ? time + " (UTC" + offset + ")" : time;
}

using Values = protocols::TextsByKey;

/// The sheet of one person. Sections stand in the order of the sheet.
class Sheet {
public:
    explicit Sheet(const ordered_json& data)
        : m_data(data), m_language(fieldText(data, "language")), m_texts(protocols::usualTexts(m_language).ownData)
    {
    }

    std::string html() const
    {
        const std::string files =
            page::section(words("files_title"), said("files_text", {{"time", readableTime(m_data, "made_at")}}));
        return page::whole(words("title", {{"study", fieldText(m_data, "study")}}),
                           introduction() + erasures() + consent() + facts() + sittings() + answers() + finger() + notes() +
                               events() + copies() + files,
                           protocols::hasUsualTexts(m_language) ? m_language : "en");
    }

private:
    using Rows = std::vector<std::vector<std::string>>;

    std::string words(const std::string& key, const Values& values = {}) const
    {
        return protocols::filledText(m_texts.at(key), values);
    }
    std::string said(const std::string& key, const Values& values = {}) const { return page::sentence(words(key, values)); }
    bool isBlinded() const { return m_data["blinded"].get<bool>(); }

    /// A table, or a sentence where there are no rows.
    std::string tableOr(const char* emptyKey, const std::vector<const char*>& head, const Rows& rows) const
    {
        if (rows.empty()) return said(emptyKey);
        std::vector<std::string> titles;
        for (const char* key : head) titles.push_back(*key == '\0' ? "" : words(key));
        return page::table(titles, rows);
    }

    std::string introduction() const
    {
        std::string body = said("code", {{"code", fieldText(m_data, "participant")}}) + said(fieldText(m_data, "state"));
        if (const std::string kind = fieldText(m_data, "kind"); kind != "human") body += said(kind);
        return body + (isBlinded() ? said("blinded") : "");
    }

    std::string erasures() const
    {
        std::string body, left = "left_facts";
        for (const auto& act : m_data["erasures"]) {
            if (act["answers_too"].get<bool>()) left = "left_all";
            body += said(act["answers_too"].get<bool>() ? "erased_all" : "erased_facts",
                         {{"time", readableTime(act)},
                          {"who", fieldText(act, "who")},
                          {"why", fieldText(act, "why")},
                          {"file", "erasure-" + fieldText(act, "entry") + ".txt"}});
        }
        return body.empty() ? "" : page::section(words("erasure_title"), body + said(left));
    }

    std::string consent() const
    {
        const auto& given = m_data["consent"];
        return page::section(
            words("consent_title"),
            (given["time"].is_null() ? said("consent_no_time") : said("consent_time", {{"time", readableTime(given)}})) +
                said("consent_words", {{"text", fieldText(given, "text")}}));
    }

    std::string facts() const
    {
        Rows rows;
        for (const auto& fact : m_data["facts"]) rows.push_back({fieldText(fact, "fact"), fieldText(fact, "value")});
        return page::section(words("facts_title"), tableOr("no_facts", {"question", "your_answer"}, rows));
    }

    std::string sittings() const
    {
        Rows rows;
        for (const auto& sitting : m_data["sittings"])
            rows.push_back({fieldText(sitting, "sitting"), readableTime(sitting, "from"), readableTime(sitting, "until")});
        return page::section(words("sittings_title"), tableOr("no_time", {"sitting", "from", "until"}, rows));
    }

    /// With the decimal mark of the language.
    std::string number(const std::string& plain) const
    {
        std::string text = plain;
        const auto point = text.find('.');
        if (point != std::string::npos) text.replace(point, 1, protocols::usualParticipantTexts(m_language).at("decimal_mark"));
        return text;
    }

    /// With one decimal; your-data.json has the rest.
    std::string secondsOf(const ordered_json& answer) const
    {
        return number(protocols::shortest(std::round(answer["seconds"].get<double>() * 10) / 10));
    }

    /// Own words stay as they were given.
    std::string answerOf(const ordered_json& answer) const
    {
        if (answer.contains("rating")) return number(fieldText(answer, "rating"));
        const std::string text = fieldText(answer, "answer"), kind = fieldText(answer, "answer_kind");
        if (kind == "same_different" && (text == "same" || text == "different")) return words(text);
        if (kind != "choice") return text;
        if (text == pieceElsewhere) return words("not_on_tray");
        if (text.starts_with(pieceNumbered)) return words("piece", {{"number", text.substr(pieceNumbered.size())}});
        return text;
    }

    std::string remarkOn(const ordered_json& answer) const
    {
        std::string remark = answer["is_correction"].get<bool>() ? words("corrects") : "";
        if (answer["voided"].get<bool>()) remark += (remark.empty() ? "" : "; ") + words("not_analysed");
        return remark;
    }

    std::string answers() const
    {
        std::vector<const char*> head{"time", "trial", "question", "your_answer", "seconds", "remark"};
        if (!isBlinded()) head.insert(head.end(), {"fabric", "condition", "right"});
        Rows rows;
        for (const auto& answer : m_data["answers"]) {
            rows.push_back({readableTime(answer), fieldText(answer, "trial"), fieldText(answer, "question"), answerOf(answer),
                            secondsOf(answer), remarkOn(answer)});
            if (isBlinded()) continue;
            const std::string right = answer.contains("correct") ? words(answer["correct"].get<bool>() ? "yes" : "no") : "";
            rows.back().insert(rows.back().end(), {fieldText(answer, "fabric"), fieldText(answer, "condition"), right});
        }
        return page::section(words("answers_title"),
                             (rows.empty() ? "" : said("answers_text")) + tableOr("no_answer", head, rows));
    }

    std::string finger() const
    {
        const std::string count = fieldText(m_data, "finger_samples");
        if (count == "0") return "";
        return page::section(words("finger_title"),
                             said("finger_text", {{"count", count}}) + said(isBlinded() ? "finger_later" : "finger_file"));
    }

    std::string notes() const
    {
        Rows rows;
        for (const auto& note : m_data["notes"])
            rows.push_back({readableTime(note), fieldText(note, "trial"), fieldText(note, "text")});
        return page::section(words("notes_title"), tableOr("no_note", {"time", "trial", "note"}, rows));
    }

    /// Empty for answers and touches, which have a table of their own; the name of a kind that has no words.
    std::string eventWords(const std::string& kind) const
    {
        if (kind == "answered" || kind == "touched" || kind == "tray_ready") return "";
        const auto known = m_texts.find("event_" + kind);
        return known == m_texts.end() ? kind : known->second;
    }

    std::string events() const
    {
        Rows rows;
        for (const auto& event : m_data["events"]) {
            const std::string happened = eventWords(fieldText(event, "kind"));
            if (happened.empty() || !event.contains("time")) continue;
            const std::string why = event.contains("details") ? fieldText(event["details"], "why") : "";
            rows.push_back({readableTime(event), why.empty() ? happened : words("reason", {{"words", happened}, {"why", why}})});
        }
        return page::section(words("events_title"), tableOr("no_time", {"time", ""}, rows));
    }

    std::string copies() const
    {
        Rows rows;
        for (const auto& copy : m_data["copies"]) {
            const std::string act = fieldText(copy, "act");
            const auto kind = m_texts.find("copy_" + (act == database::personExport ? "export" : act));
            rows.push_back({readableTime(copy), kind == m_texts.end() ? fieldText(copy, "act") : kind->second,
                            fieldText(copy, "host") + ": " + fieldText(copy, "path")});
        }
        return page::section(words("copies_title"), (rows.empty() ? "" : said("copies_text")) +
                                                        tableOr("no_copy", {"time", "copy_kind", "copy_place"}, rows));
    }

    const ordered_json& m_data;
    std::string m_language;
    const protocols::TextsByKey& m_texts;
};

}  // namespace

std::string participantPage(const ordered_json& data) { return Sheet(data).html(); }

}  // namespace study::records
