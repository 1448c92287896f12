#include "study/records/evidence/data_sheet_text.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "protocols/files/safe_text.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t widest = 100;

std::string cell(const ordered_json& row, const char* key)
{
    if (!row.contains(key) || row[key].is_null()) return "";
    return protocols::printable(row[key].is_string() ? row[key].get<std::string>() : row[key].dump());
}

/// Lines of at most `widest` characters, the first after `first`, the others after as many blanks.
std::string wrapped(const std::string& first, const std::string& text)
{
    std::string lines = first, word;
    std::size_t width = first.size();
    std::istringstream words(text);
    for (bool isFirst = true; words >> word; isFirst = false) {
        if (!isFirst && width + 1 + word.size() > widest) {
            lines += "\n" + std::string(first.size(), ' ');
            width = first.size();
        } else if (!isFirst) {
            lines += ' ';
            ++width;
        }
        lines += word;
        width += word.size();
    }
    return lines + "\n";
}

std::string heading(const std::string& text) { return "\n" + text + "\n" + std::string(text.size(), '-') + "\n"; }

std::string listed(const ordered_json& sentences)
{
    std::string text;
    for (const auto& sentence : sentences) text += wrapped("- ", protocols::printable(sentence.get<std::string>()));
    return text;
}

std::string counts(const ordered_json& numbers)
{
    std::string text;
    for (const auto& [name, number] : numbers.items()) text += (text.empty() ? "" : ", ") + number.dump() + " " + name;
    return text;
}

std::string people(const ordered_json& sheet)
{
    std::string asked;
    for (const auto& fact : sheet["facts_asked"])
        asked += (asked.empty() ? "" : ", ") + protocols::printable(fact.get<std::string>());
    return heading("1. Participants") +
           wrapped("", "Participants appear under codes. " + counts(sheet["participants"]["kinds"]) + "; " +
                           counts(sheet["participants"]["states"]) + ".") +
           wrapped("", asked.empty() ? "The protocol asks for no facts about them."
                                     : "The protocol asks for these facts, each optional: " + asked + ".") +
           wrapped("", "Consent: " + protocols::printable(sheet["consent"].get<std::string>()));
}

std::string place(const ordered_json& sheet)
{
    std::string text = heading("2. Place and protection");
    text += wrapped("", "Folder " + cell(sheet["place"], "folder") + " on the computer " + cell(sheet["place"], "host") + ".");
    text += listed(sheet["protection"]) + "\n";
    for (const auto& file : sheet["place"]["files"])
        text += wrapped("- ", cell(file, "name") + ", mode " + cell(file, "mode") + ", " + cell(file, "bytes") +
                                  " bytes: " + cell(file, "what") + " (" + cell(file, "protection") + ")");
    return text + listed(sheet["elsewhere"]);
}

std::string columns(const ordered_json& table)
{
    std::string text;
    for (const auto& column : table["columns"]) {
        const std::string atErasure = cell(column, "at_erasure");
        text += wrapped("    ", cell(column, "column") + ": " +
                                    (column["what"].is_null() ? cell(column["why"], "what") : cell(column, "what")) +
                                    (atErasure.empty() ? "" : " [" + atErasure + "]"));
    }
    return text;
}

std::string content(const ordered_json& sheet)
{
    std::string text = heading("3. Content of the database") +
                       wrapped("", "Columns about participants carry in brackets what an erasure does to them.");
    for (const auto& table : sheet["tables"])
        text += wrapped("- ", cell(table, "table") + " (" + cell(table, "rows") + " rows): " + cell(table, "what") +
                                  (table["personal"].get<bool>() ? "" : "; nothing about participants")) +
                columns(table);
    return text;
}

std::string readers(const ordered_json& sheet)
{
    std::string text = heading("4. Readers");
    for (const auto& reader : sheet["readers"])
        text += wrapped("- ", cell(reader, "who")) + wrapped("    before the unblinding: ", cell(reader, "before_unblinding")) +
                wrapped("    after it: ", cell(reader, "after_unblinding"));
    return text + wrapped("", sheet["blinded"].get<bool>() ? "The study is blinded now." : "The study is unblinded now.");
}

std::string duration(const ordered_json& sheet)
{
    return heading("5. Duration") +
           wrapped("", "The study was made on " + cell(sheet["duration"], "since") + ". Its log has " +
                           cell(sheet["duration"], "entries") + " entries.") +
           wrapped("", "No period of storage is known: " + cell(sheet["duration"]["why"], "period") +
                           ". State the period here, and delete the folder and its copies at its end.");
}

std::string erasure(const ordered_json& sheet)
{
    std::string text = heading("6. Erasure") + "What it does:\n" + listed(sheet["erasure"]["does"]) + "What it cannot do:\n" +
                       listed(sheet["erasure"]["cannot"]);
    for (const auto& act : sheet["erasure"]["done"])
        text += wrapped("", "Done on " + cell(act, "time") + ": " +
                                (act["answers_too"].get<bool>() ? "facts, answers, notes and times." : "facts and debriefing."));
    return sheet["erasure"]["done"].empty() ? text + "None was done so far.\n" : text;
}

std::string acts(const ordered_json& sheet)
{
    std::string text = heading("7. Copies and acts on record");
    for (const auto& act : sheet["acts"])
        text += wrapped("- ", cell(act, "time") + ": " + cell(act, "act") + " by " + cell(act, "who") + " on " +
                                  cell(act, "host") + (cell(act, "path").empty() ? "" : ": " + cell(act, "path")));
    if (sheet["acts"].empty()) text += "None is on record.\n";
    return text + "Copies that somebody made by hand are on no record.\n";
}

}  // namespace

std::string textOfDataSheet(const ordered_json& sheet)
{
    std::string text = wrapped("", "Data sheet of the study " + cell(sheet, "study"));
    text +=
        wrapped("", "Made on " + cell(sheet, "made_at") + " from the study itself, which " + cell(sheet, "program") + " made.");
    text +=
        wrapped("", "Protocol SHA-256 " + cell(sheet, "protocol_sha256")) + wrapped("", "Log head " + cell(sheet, "log_head"));
    text += people(sheet) + place(sheet) + content(sheet) + readers(sheet) + duration(sheet) + erasure(sheet) + acts(sheet);
    return text + heading("8. Contact") + wrapped("", cell(sheet["why"], "contact") + ": add the name and the address here.");
}

}  // namespace study::records
