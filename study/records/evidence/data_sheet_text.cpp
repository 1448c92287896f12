#include "study/records/evidence/data_sheet_text.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "protocols/files/safe_text.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t widest = 100;

std::string sheetField(const ordered_json& row, const char* key)
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

std::string chapterHeading(const std::string& text) { return "\n" + text + "\n" + std::string(text.size(), '-') + "\n"; }

std::string bulleted(const ordered_json& sentences)
{
    std::string text;
    for (const auto& sentence : sentences) text += wrapped("- ", protocols::printable(sentence.get<std::string>()));
    return text;
}

std::string countsText(const ordered_json& numbers)
{
    std::string text;
    for (const auto& [name, number] : numbers.items()) text += (text.empty() ? "" : ", ") + number.dump() + " " + name;
    return text;
}

std::string peopleChapter(const ordered_json& sheet)
{
    std::string asked;
    for (const auto& fact : sheet["facts_asked"])
        asked += (asked.empty() ? "" : ", ") + protocols::printable(fact.get<std::string>());
    std::string consents = wrapped("", "Consent: " + protocols::printable(sheet["consent"].get<std::string>()));
    for (const auto& before : sheet["consents_before"])
        consents += wrapped("", "Consent up to version " + before["version"].dump() +
                                    " of the protocol: " + protocols::printable(before["text"].get<std::string>()));
    return chapterHeading("1. Participants") +
           wrapped("", "Participants appear under codes. " + countsText(sheet["participants"]["kinds"]) + "; " +
                           countsText(sheet["participants"]["states"]) + ".") +
           wrapped("", asked.empty() ? "The protocol asks for no facts about them."
                                     : "The protocol asks for these facts, each optional: " + asked + ".") +
           consents;
}

std::string placeChapter(const ordered_json& sheet)
{
    std::string text = chapterHeading("2. Place and protection");
    text += wrapped(
        "", "Folder " + sheetField(sheet["place"], "folder") + " on the computer " + sheetField(sheet["place"], "host") + ".");
    if (const std::string server = sheetField(sheet["place"], "server"); !server.empty())
        text += wrapped("", "The database lies on the server " + server + ". The folder holds the rest.");
    text += bulleted(sheet["protection"]) + "\n";
    for (const auto& file : sheet["place"]["files"])
        text += wrapped("- ", sheetField(file, "name") + ", mode " + sheetField(file, "mode") + ", " + sheetField(file, "bytes") +
                                  " bytes: " + sheetField(file, "what") + " (" + sheetField(file, "protection") + ")");
    return text + bulleted(sheet["elsewhere"]);
}

std::string rowsText(const ordered_json& number) { return number.dump() + (number == 1 ? " row" : " rows"); }

std::string columnLines(const ordered_json& table)
{
    std::string text;
    for (const auto& column : table["columns"]) {
        const std::string atErasure = sheetField(column, "at_erasure");
        text += wrapped("    ", sheetField(column, "column") + ": " +
                                    (column["what"].is_null() ? sheetField(column["why"], "what") : sheetField(column, "what")) +
                                    (atErasure.empty() ? "" : " [" + atErasure + "]"));
    }
    return text;
}

std::string contentChapter(const ordered_json& sheet)
{
    std::string text = chapterHeading("3. Content of the database") +
                       wrapped("", "Columns about participants carry in brackets what an erasure does to them.");
    for (const auto& table : sheet["tables"])
        text += wrapped("- ", sheetField(table, "table") + " (" + rowsText(table["rows"]) + "): " + sheetField(table, "what") +
                                  (table["personal"].get<bool>() ? "" : "; nothing about participants")) +
                columnLines(table);
    return text;
}

std::string readersChapter(const ordered_json& sheet)
{
    std::string text = chapterHeading("4. Readers");
    for (const auto& reader : sheet["readers"])
        text += wrapped("- ", sheetField(reader, "who")) +
                wrapped("    before the unblinding: ", sheetField(reader, "before_unblinding")) +
                wrapped("    after it: ", sheetField(reader, "after_unblinding"));
    return text + wrapped("", sheet["blinded"].get<bool>() ? "The study is blinded now." : "The study is unblinded now.");
}

std::string durationChapter(const ordered_json& sheet)
{
    return chapterHeading("5. Duration") +
           wrapped("", "The study was made on " + sheetField(sheet["duration"], "since") + ". Its log has " +
                           sheetField(sheet["duration"], "entries") + " entries.") +
           wrapped("", "No period of storage is known: " + sheetField(sheet["duration"]["why"], "period") +
                           ". State the period here, and delete the folder and its copies at its end.");
}

std::string erasureChapter(const ordered_json& sheet)
{
    std::string text = chapterHeading("6. Erasure") + "What it does:\n" + bulleted(sheet["erasure"]["does"]) +
                       "What it cannot do:\n" + bulleted(sheet["erasure"]["cannot"]);
    for (const auto& act : sheet["erasure"]["done"])
        text += wrapped("", "Done on " + sheetField(act, "time") + ": " +
                                (act["answers_too"].get<bool>() ? "facts, answers, notes and times." : "facts and debriefing."));
    return sheet["erasure"]["done"].empty() ? text + "None was done so far.\n" : text;
}

std::string actsChapter(const ordered_json& sheet)
{
    std::string text = chapterHeading("7. Copies and acts on record");
    for (const auto& act : sheet["acts"])
        text +=
            wrapped("- ", sheetField(act, "time") + ": " + sheetField(act, "act") + " by " + sheetField(act, "who") + " on " +
                              sheetField(act, "host") + (sheetField(act, "path").empty() ? "" : ": " + sheetField(act, "path")));
    if (sheet["acts"].empty()) text += "None is on record.\n";
    return text + "Copies that somebody made by hand are on no record.\n";
}

}  // namespace

std::string textOfDataSheet(const ordered_json& sheet)
{
    std::string text = wrapped("", "Data sheet of the study " + sheetField(sheet, "study"));
    text += wrapped("", "Made on " + sheetField(sheet, "made_at") + " from the study itself, which " +
                            sheetField(sheet, "program") + " made.");
    text += wrapped("", "Protocol SHA-256 " + sheetField(sheet, "protocol_sha256")) +
            wrapped("", "Log head " + sheetField(sheet, "log_head")) + wrapped("", sheetField(sheet, "display_response"));
    text += peopleChapter(sheet) + placeChapter(sheet) + contentChapter(sheet) + readersChapter(sheet) + durationChapter(sheet) +
            erasureChapter(sheet) + actsChapter(sheet);
    return text + chapterHeading("8. Contact") +
           wrapped("", "No contact is known: " + sheetField(sheet["why"], "contact") + ". Add the name and the address here.");
}

}  // namespace study::records
