#include "study/records/evidence/participant_page.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/number_text.h"
#include "study/records/evidence/printed_page.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

/// What an event means to the participant. Answers and touches have a table of their own.
struct EventWords {
    const char* kind;
    const char* words;  ///< null: left out
};
constexpr EventWords eventWords[] = {
    {"sitting_started", "A sitting began."},
    {"begun", "The session began."},
    {"consented", "You agreed to take part."},
    {"facts_given", "You answered questions about yourself."},
    {"familiarisation_shown", "You felt a fabric on the screen for practice."},
    {"familiarisation_done", "The practice with the screen ended."},
    {"scale_placed", "You placed a number on the scale for practice."},
    {"scale_training_done", "The practice with the scale ended."},
    {"checklist_done", "The operator completed the checklist."},
    {"sitting_prepared", "The sitting was prepared."},
    {"tray_ready", nullptr},
    {"touched", nullptr},
    {"answered", nullptr},
    {"corrected", "One of your answers was corrected."},
    {"voided", "A presentation was declared invalid. Its answers are kept and not analysed."},
    {"break_ended", "A break ended."},
    {"paused", "The session was interrupted."},
    {"resumed", "The session continued."},
    {"withdrawn", "You ended your participation."},
    {"noted", "The operator wrote a note."},
    {"debriefed", "The final conversation took place."},
};

std::string wordsFor(const std::string& kind)
{
    for (const EventWords& known : eventWords)
        if (kind == known.kind) return known.words == nullptr ? "" : known.words;
    return kind;
}

std::string fieldText(const ordered_json& row, const char* key)
{
    if (!row.contains(key) || row[key].is_null()) return "";
    const auto& value = row[key];
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return protocols::shortest(value.get<double>());
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// With one decimal; your-data.json has the rest.
std::string inSeconds(const ordered_json& answer)
{
    const double tenths = std::round(answer["seconds"].get<double>() * 10);
    return protocols::shortest(tenths / 10);
}

/// "2026-11-22 14:03:11" for an ISO 8601 time: a reader needs no milliseconds.
std::string readableTime(const ordered_json& row, const char* key = "time")
{
    std::string time = fieldText(row, key).substr(0, 19);
    if (time.size() == 19 && time[10] == 'T') time[10] = ' ';
    return time;
}

std::string introduction(const ordered_json& data)
{
    std::string body = page::sentence("You take part under the code " + fieldText(data, "participant") + ".");
    const std::string state = fieldText(data, "state");
    if (state == "withdrawn") body += page::sentence("Your participation has ended early. Your answers are not analysed.");
    if (state == "finished") body += page::sentence("You have finished the study.");
    if (state == "started") body += page::sentence("Your participation is not finished.");
    if (fieldText(data, "kind") != "human")
        body += page::sentence("This participant is no person: the program made the answers (" + fieldText(data, "kind") + ").");
    if (data["blinded"].get<bool>())
        body += page::sentence(
            "The study still hides what the screen showed in each trial. So this sheet does not say which answer was right. You "
            "may ask for a new sheet after the study.");
    return body;
}

std::string erasureSection(const ordered_json& data)
{
    std::string body;
    for (const auto& act : data["erasures"])
        body += page::sentence(
            std::string(act["answers_too"].get<bool>() ? "Facts, comments, answers, notes and times were erased on "
                                                       : "Facts about you and your comments after the session were erased on ") +
            readableTime(act) + ", ordered by " + fieldText(act, "who") + ". Reason: " + fieldText(act, "why") +
            ". The file erasure-" + fieldText(act, "entry") + ".txt is the certificate.");
    if (!body.empty())
        body += page::sentence(
            "What is left: your code, the number of your running order, and the kinds of your entries in the log without "
            "their content.");
    return body.empty() ? "" : page::section("Erasure", body);
}

std::string consentSection(const ordered_json& data)
{
    const auto& given = data["consent"];
    const std::string when = given["time"].is_null() ? "The study stores no time of your consent."
                                                     : "The operator confirmed your consent on " + readableTime(given) + ".";
    return page::section("Consent", page::sentence(when) + page::sentence("The text was: “" + fieldText(given, "text") + "”"));
}

std::string factSection(const ordered_json& data)
{
    std::vector<std::vector<std::string>> rows;
    for (const auto& fact : data["facts"]) rows.push_back({fieldText(fact, "fact"), fieldText(fact, "value")});
    return page::section("What you told us about yourself",
                         rows.empty() ? page::sentence("Nothing is stored.") : page::table({"question", "your answer"}, rows));
}

std::string sittingSection(const ordered_json& data)
{
    std::vector<std::vector<std::string>> rows;
    for (const auto& sitting : data["sittings"])
        rows.push_back({fieldText(sitting, "sitting"), readableTime(sitting, "from"), readableTime(sitting, "until")});
    return page::section("Your sittings",
                         rows.empty() ? page::sentence("No time is stored.") : page::table({"sitting", "from", "until"}, rows));
}

std::string remarkOn(const ordered_json& answer)
{
    std::string remark = answer["is_correction"].get<bool>() ? "corrects the answer before" : "";
    if (answer["voided"].get<bool>()) remark += std::string(remark.empty() ? "" : "; ") + "not analysed";
    return remark;
}

std::string answerSection(const ordered_json& data)
{
    const bool isBlinded = data["blinded"].get<bool>();
    std::vector<std::string> head{"time", "trial", "question", "your answer", "seconds", "remark"};
    if (!isBlinded) head.insert(head.end(), {"fabric", "condition", "right"});
    std::vector<std::vector<std::string>> rows;
    for (const auto& answer : data["answers"]) {
        rows.push_back({readableTime(answer), fieldText(answer, "trial"), fieldText(answer, "question"),
                        fieldText(answer, answer.contains("rating") ? "rating" : "answer"), inSeconds(answer), remarkOn(answer)});
        if (isBlinded) continue;
        const std::string right = answer.contains("correct") ? (answer["correct"].get<bool>() ? "yes" : "no") : "";
        rows.back().insert(rows.back().end(), {fieldText(answer, "fabric"), fieldText(answer, "condition"), right});
    }
    if (rows.empty()) return page::section("Your answers", page::sentence("No answer is stored."));
    return page::section(
        "Your answers",
        page::sentence("A letter names a place on the tray. Seconds run from the first touch to the answer, or from "
                       "the start of the presentation where no touch was stamped.") +
            page::table(head, rows));
}

std::string fingerSection(const ordered_json& data)
{
    const auto count = data["finger_samples"].get<std::int64_t>();
    if (count == 0) return "";
    const std::string what = "The screen measured where your finger was, or how strongly it pressed: " + std::to_string(count) +
                             (count == 1 ? " measurement is" : " measurements are") + " stored. ";
    return page::section("Your finger on the screen",
                         page::sentence(what + (data["blinded"].get<bool>()
                                                    ? "You get them with a new sheet after the study, because they could show "
                                                      "what the screen presented."
                                                    : "They are in your-finger-samples.csv.")));
}

std::string noteSection(const ordered_json& data)
{
    std::vector<std::vector<std::string>> rows;
    for (const auto& note : data["notes"])
        rows.push_back({readableTime(note), fieldText(note, "trial"), fieldText(note, "text")});
    return page::section("Notes of the operator during your session",
                         rows.empty() ? page::sentence("No note is stored.") : page::table({"time", "trial", "note"}, rows));
}

std::string eventSection(const ordered_json& data)
{
    std::vector<std::vector<std::string>> rows;
    for (const auto& event : data["events"]) {
        const std::string words = wordsFor(fieldText(event, "kind"));
        const std::string reason = event.contains("details") ? fieldText(event["details"], "why") : "";
        if (!words.empty() && event.contains("time"))
            rows.push_back({readableTime(event), words + (reason.empty() ? "" : " Reason: " + reason)});
    }
    return page::section("What happened", rows.empty() ? page::sentence("No time is stored.") : page::table({"time", ""}, rows));
}

std::string copySection(const ordered_json& data)
{
    std::vector<std::vector<std::string>> rows;
    for (const auto& copy : data["copies"])
        rows.push_back({readableTime(copy), fieldText(copy, "act"), fieldText(copy, "host") + ": " + fieldText(copy, "path")});
    const std::string first =
        page::sentence("These copies of the study may hold data about you. Copies that somebody made by hand are on no record.");
    return page::section("Copies", rows.empty() ? page::sentence("The study has no record of a copy with your data.")
                                                : first + page::table({"time", "kind", "place"}, rows));
}

}  // namespace

std::string participantPage(const ordered_json& data)
{
    const std::string body = introduction(data) + erasureSection(data) + consentSection(data) + factSection(data) +
                             sittingSection(data) + answerSection(data) + fingerSection(data) + noteSection(data) +
                             eventSection(data) + copySection(data) +
                             page::section("Files", page::sentence("your-data.json holds everything in this sheet and the times "
                                                                   "of each step. your-answers.csv holds the answers as a "
                                                                   "table. This sheet was made on " +
                                                                   readableTime(data, "made_at") + "."));
    return page::whole("Your data in the study " + fieldText(data, "study"), body);
}

}  // namespace study::records
