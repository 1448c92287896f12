// vis2hap export STUDY --out DIR [--format csv|json|script] [--with-log] [--with-samples]: answers after the unblinding, before
// it progress and aggregates. With --participant ID the data of one person, for this person.
#include "study/commands/export_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "database/evidence/acts.h"
#include "database/preregistrations.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/question_ids.h"
#include "reports/formats/table_formats.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/players/session_script.h"
#include "study/records/blinded_report.h"
#include "study/records/evidence/exported_log.h"
#include "study/records/evidence/exported_samples.h"
#include "study/records/evidence/participant_data.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
using database::CurrentAnswer;
using nlohmann::ordered_json;

struct Export {
    const database::StudyStore& store;
    database::StudyFacts facts;
    protocols::Protocol protocol;
    const records::Naming* naming;  ///< null while the study is blinded
    fs::path out;                   ///< a draft, which is synced as a whole
};

constexpr std::size_t bytesAtOnce = std::size_t{1} << 20;

/// A value of an answer; none where it does not exist.
using ExportedValue = std::variant<std::monostate, std::int64_t, double, std::string, std::vector<std::string>>;

template <class T>
ExportedValue valueIfThere(const std::optional<T>& value)
{
    return value ? ExportedValue(*value) : ExportedValue();
}

struct NamedValue {
    const char* name;
    ExportedValue value;
};

void addInstruction(std::vector<NamedValue>& row, const records::Naming::Entry& entry, const CurrentAnswer& answer)
{
    row.push_back({"instruction", entry.instruction.empty() ? ExportedValue() : ExportedValue(entry.instruction.value)});
    row.push_back({"deadline_seconds", entry.deadlineMs ? ExportedValue(*entry.deadlineMs / 1000.0) : ExportedValue()});
    const auto late = isLate(entry, answer);
    row.push_back({"late", late ? ExportedValue(std::int64_t{*late}) : ExportedValue()});
}

/// One answer of an unblinded study, in the order of export.json.
std::vector<NamedValue> rowOf(const Export& job, const CurrentAnswer& answer)
{
    const auto& record = answer.record;
    const auto& entry = job.naming->of(answer.participant, record.trial);
    std::vector<std::string> alternatives;
    for (const auto& fabric : record.alternatives) alternatives.push_back(fabric.value);
    const auto* question = questionWith(job.protocol, record.question);
    const auto right =
        record.answer && question ? isRight(question->kind, record.alternatives, entry.fabric, *record.answer) : std::nullopt;
    const auto ifTouched = [&](const std::string& by) { return record.touchedAtNs ? ExportedValue(by) : ExportedValue(); };
    const auto ifBegun = [&](const std::string& by) { return record.answerBegunAtNs ? ExportedValue(by) : ExportedValue(); };
    std::vector<NamedValue> row{{"participant", answer.participant.value},
                                {"trial", std::int64_t{record.trial.value}},
                                {"question", record.question.value},
                                {"fabric", entry.fabric.value},
                                {"condition", entry.condition},
                                {"alternatives", std::move(alternatives)},
                                {"answer", valueIfThere(record.answer)},
                                {"correct", right ? ExportedValue(std::int64_t{*right}) : ExportedValue()},
                                {"rating", record.rating ? ExportedValue(record.rating->inScaleUnits()) : ExportedValue()},
                                {"seconds", answer.seconds},
                                {"response_seconds", valueIfThere(answer.responseSeconds)},
                                {"ready_at", record.readyAtNs},
                                {"touched_at", valueIfThere(record.touchedAtNs)},
                                {"touched_by", ifTouched(record.touchedBy)},
                                {"touch_ended_at", valueIfThere(record.touchEndedAtNs)},
                                {"answer_begun_at", valueIfThere(record.answerBegunAtNs)},
                                {"answer_begun_by", ifBegun(record.answerBegunBy)},
                                {"answered_at", record.answeredAtNs},
                                {"stored_at", answer.storedAtNs},
                                {"corrections", std::int64_t{answer.corrections}},
                                {"voided", std::int64_t{answer.voided}},
                                {"wall_time", answer.wallTime},
                                {"note", record.note},
                                {"entries", record.entries ? ExportedValue(std::int64_t{*record.entries}) : ExportedValue()}};
    if (hasInstructions(job.protocol)) addInstruction(row, entry, answer);
    return row;
}

ordered_json jsonRowOf(const std::vector<NamedValue>& row)
{
    ordered_json json = ordered_json::object();
    for (const auto& [name, value] : row)
        std::visit(protocols::Overloaded{[&, key = name](std::monostate) { json[key] = nullptr; },
                                         [&, key = name](const auto& known) { json[key] = known; }},
                   value);
    return json;
}

/// The text of a CSV cell, not yet quoted. Words of people may begin like a formula.
std::string cell(const ExportedValue& value)
{
    return std::visit(protocols::Overloaded{[](std::monostate) { return std::string(); },
                                            [](std::int64_t number) { return std::to_string(number); },
                                            [](double number) { return protocols::shortest(number); },
                                            [](const std::string& text) { return protocols::safeCell(text); },
                                            [](const std::vector<std::string>& texts) { return ordered_json(texts).dump(); }},
                      value);
}

/// The text of a CSV cell, not yet quoted.
std::string cell(const ordered_json& value)
{
    if (value.is_null()) return "";
    if (value.is_string()) return protocols::safeCell(value.get<std::string>());
    return value.is_number_float() ? protocols::shortest(value.get<double>()) : value.dump();
}

ordered_json participantRows(const Export& job)
{
    ordered_json rows = ordered_json::array();
    for (const auto& enrolment : job.store.enrolments())
        rows.push_back({{"slot", enrolment.slot},
                        {"participant", enrolment.participant.value},
                        {"kind", nameOf(enrolment.kind)},
                        {"state", nameOf(enrolment.state)},
                        {"protocol_version", enrolment.protocolVersion}});
    return rows;
}

/// The registered plans themselves are files of the study folder.
ordered_json registrationRows(const Export& job)
{
    ordered_json rows = ordered_json::array();
    for (const auto& record : preregistrationsOf(job.store))
        rows.push_back({{"number", record.number},
                        {"time", record.wallTime},
                        {"sha256", record.jsonSha256()},
                        {"text_sha256", record.textSha256()},
                        {"answers_before", record.answersBefore},
                        {"after_unblinding", record.afterUnblinding}});
    return rows;
}

/// Exports, backups and reports before this one.
ordered_json actRows(const Export& job)
{
    ordered_json rows = ordered_json::array();
    for (const auto& act : actsOf(job.store))
        rows.push_back({{"act", act.kind},
                        {"time", act.wallTime},
                        {"who", act.who},
                        {"program", act.program},
                        {"host", act.host},
                        {"path", act.path},
                        {"log_head", textOf(act.head)}});
    return rows;
}

std::string csvOf(const ordered_json& rows, const std::vector<std::string>& columns)
{
    std::string text = protocols::csvRow(columns);
    for (const auto& row : rows) {
        std::vector<std::string> cells;
        for (const auto& column : columns) cells.push_back(cell(row[column]));
        text += protocols::csvRow(cells);
    }
    return text;
}

void write(const Export& job, const char* name, const std::string& text)
{
    protocols::writeWholeFile(job.out / name, text, protocols::Sync::Later);
}

/// The answers one by one: a large study is never held as a whole.
void writeAnswersCsv(const Export& job, const protocols::TakeBytes& take)
{
    std::vector<std::string> columns(protocols::answerColumns().begin(), protocols::answerColumns().end());
    if (hasInstructions(job.protocol)) columns.insert(columns.end(), {"instruction", "deadline_seconds", "late"});
    take(protocols::csvRow(columns));
    std::vector<std::string> cells(columns.size());
    std::string rows;
    job.store.eachAnswer([&](const CurrentAnswer& answer) {
        for (const auto& [name, value] : rowOf(job, answer))
            if (const auto column = std::ranges::find(columns, name); column != columns.end())
                cells[static_cast<std::size_t>(column - columns.begin())] = cell(value);
        rows += protocols::csvRow(cells);
        if (rows.size() < bytesAtOnce) return;
        take(rows);
        rows.clear();
    });
    take(rows);
}

void writeCsv(const Export& job)
{
    protocols::writeInPieces(
        job.out / "answers.csv", [&](const protocols::TakeBytes& take) { writeAnswersCsv(job, take); }, protocols::Sync::Later);
    write(job, "participants.csv", csvOf(participantRows(job), {"slot", "participant", "kind", "state", "protocol_version"}));
}

/// Studies of earlier versions may not know it.
ordered_json madeWithOf(const Export& job)
{
    ordered_json made = ordered_json::parse(job.facts.madeWith, nullptr, false);
    return made.is_object() ? made : ordered_json::object();
}

ordered_json headOf(const Export& job)
{
    return {{"schema", "vis2hap.export/1"},
            {"study", job.facts.name},
            {"protocol_sha256", job.facts.protocolSha256},
            {"blinded", job.naming == nullptr},
            {"stamps", records::stampsOf(job.store, job.facts)},
            {"participants", participantRows(job)},
            {"preregistrations", registrationRows(job)},
            {"acts", actRows(job)},
            {"made_with", madeWithOf(job)},
            {"log_head", textOf(job.store.head())}};
}

/// The text of a whole object with a row for each answer, without holding the rows.
void writeAnswersJson(const Export& job, const protocols::TakeBytes& take)
{
    std::string text = headOf(job).dump(1);
    text.resize(text.size() - 2);  // the line end and the brace
    text += ",\n \"answers\": [";
    bool isFirst = true;
    job.store.eachAnswer([&](const CurrentAnswer& answer) {
        text += std::exchange(isFirst, false) ? "\n" : ",\n";
        for (const char c : "  " + jsonRowOf(rowOf(job, answer)).dump(1)) {
            text += c;
            if (c == '\n') text += "  ";
        }
        if (text.size() < bytesAtOnce) return;
        take(text);
        text.clear();
    });
    take(text + (isFirst ? "]\n}\n" : "\n ]\n}\n"));
}

void writeJsonExport(const Export& job)
{
    protocols::writeInPieces(
        job.out / "export.json", [&](const protocols::TakeBytes& take) { writeAnswersJson(job, take); }, protocols::Sync::Later);
}

/// Progress, balance and flags; with the key also aggregates under K-labels.
void writeBlinded(const Export& job, const std::string& format, const std::optional<reports::StudyData>& data)
{
    const auto report = records::blindedReport(job.store);
    const auto aggregates = data ? records::aggregatesOf(*data) : ordered_json();
    if (format == "csv") {
        for (const auto& table : report.tables) write(job, (table.name + ".csv").c_str(), toCsv(table));
        if (data) write(job, "conditions.csv", csvOf(aggregates, {"question", "condition", "n", "correct", "mean"}));
        return;
    }
    ordered_json json = headOf(job);
    json["progress"] = ordered_json::parse(report.results)["progress"];
    json["conditions"] = aggregates;
    if (!data) json["why"] = {{"conditions", "the study is blinded, and nobody gave its passphrase"}};
    write(job, "export.json", json.dump(1) + "\n");
}

struct ExportCall {
    std::string study, out, format = "csv", participant;
    bool withLog = false, withSamples = false;
    PassphraseOption passphrase;
};

int exportStudy(const ExportCall& call)
{
    const auto& [study, out, format, participant, withLog, withSamples, passphrase] = call;
    const auto store = records::openStudy(study);
    writeExport(store, out, {format, withLog, withSamples}, passphraseFrom(passphrase));
    std::printf("%s: %s as %s%s\n", out.c_str(), reports::counted(store.answerCount(), "answer").c_str(), format.c_str(),
                store.unblinding() ? "" : ", blinded (no condition, no fabric)");
    std::printf("  log head %s\n", textOf(store.head()).c_str());
    if (withLog) std::printf("  log.csv holds the log, acts.csv what was exported and saved; log.txt says how to check both\n");
    if (withSamples) std::printf("  finger_samples.csv holds what the display measured of the fingers\n");
    recordAct(store, "export", out);
    return 0;
}

/// "2 answers, 1 fact, 0 notes"
std::string countsOf(const ordered_json& data)
{
    return reports::counted(data["answers"].size(), "answer") + ", " + reports::counted(data["facts"].size(), "fact") + ", " +
           reports::counted(data["notes"].size(), "note");
}

/// The data of one person, as the law of data protection asks for them.
int exportPerson(const ExportCall& call)
{
    const auto store = records::openStudy(call.study);
    const auto data = records::participantData(store, protocols::ParticipantId(call.participant));
    protocols::FolderDraft draft(call.out, protocols::Earlier::FilesJoined);
    records::writeParticipantData(store, data, draft.path());
    draft.putInPlace();
    std::printf("%s: data of %s: %s%s\n", call.out.c_str(), protocols::printable(call.participant).c_str(),
                countsOf(data).c_str(),
                data["blinded"].get<bool>() ? ", blinded (no condition, no fabric, nothing about right or wrong)" : "");
    for (const auto& act : data["erasures"])
        std::printf("  erased on %s: %s; what is left is in the files, with the certificate\n",
                    act["time"].get<std::string>().c_str(),
                    act["answers_too"].get<bool>() ? "facts, debriefing, answers, notes and times" : "facts and debriefing");
    std::printf("  your-data.html is the sheet for this person\n");
    recordAct(store, "export", call.out);
    return 0;
}

}  // namespace

void writeExport(const database::StudyStore& store, const fs::path& out, const ExportForm& form,
                 const database::Passphrase& passphrase)
{
    const std::string& format = form.format;
    auto facts = store.facts();
    const auto protocol = records::protocolOf(facts);
    const bool blinded = !store.unblinding();
    const auto naming = blinded ? std::nullopt : records::namingOf(store, protocol, {});
    if (form.withSamples && blinded)
        throw protocols::badInput(
            {"samples of the finger are exported after the unblinding only, because the speed and the force "
             "of a presentation could give its condition away",
             store.folder().folder.string(), "a study that is unblinded, or no --with-samples",
             "export without --with-samples, or unblind the study first"});
    protocols::FolderDraft draft(out, protocols::Earlier::FilesJoined);
    const Export job{store, facts, protocol, naming ? &*naming : nullptr, draft.path()};
    if (format == "script")
        players::writeScripts(job.store, job.naming, job.out);
    else if (blinded)
        writeBlinded(job, format, records::studyData(store, passphrase));
    else if (format == "csv")
        writeCsv(job);
    else
        writeJsonExport(job);
    if (form.withSamples) write(job, "finger_samples.csv", records::fingerSamplesCsv(store, {}, naming));
    if (form.withLog) records::writeExportedLog(store, draft.path());
    draft.putInPlace();
}

void addExport(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("export", "answers and participants as files; blinded until the study is unblinded");
    auto call = std::make_shared<ExportCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--out", call->out, "folder to write into")->required();
    auto* format = command->add_option("--format", call->format, "csv, json, or script (sessions that `replay` takes)")
                       ->check(CLI::IsMember({"csv", "json", "script"}))
                       ->capture_default_str();
    auto* withLog =
        command->add_flag("--with-log", call->withLog,
                          "add the log (log.csv), the acts (acts.csv) and how to check them (log.txt); no content, no salts");
    auto* withSamples =
        command->add_flag("--with-samples", call->withSamples,
                          "add what displays measured of the fingers (finger_samples.csv); unblinded studies only");
    command
        ->add_option("--participant", call->participant,
                     "write the data of this participant only, with a sheet for the person (your-data.html)")
        ->excludes(format)
        ->excludes(withLog)
        ->excludes(withSamples);
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return call->participant.empty() ? exportStudy(*call) : exportPerson(*call); };
    });
}

}  // namespace study::commands
