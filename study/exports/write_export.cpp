#include "study/exports/write_export.h"

#include <chrono>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "database/evidence/acts.h"
#include "database/preregistrations.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "reports/formats/table_formats.h"
#include "study/exports/codebook.h"
#include "study/exports/exported_answers.h"
#include "study/exports/psych_ds.h"
#include "study/exports/public_files.h"
#include "study/players/session_script.h"
#include "study/records/blinded_report.h"
#include "study/records/display_response_record.h"
#include "study/records/evidence/exported_log.h"
#include "study/records/evidence/exported_samples.h"
#include "study/records/log_heads.h"
#include "study/records/shown_origin.h"
#include "study/records/stored_study.h"

namespace study::exports {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct Export {
    const database::StudyStore& store;
    database::StudyFacts facts;
    protocols::Protocol protocol;
    const ExportedAnswers* answers;  ///< null while the study is blinded
    fs::path out;                    ///< a draft, which is synced as a whole
};

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

/// A table of an export; its name has no extension.
struct ExportedTable {
    std::string name;
    std::function<void(const protocols::TakeBytes&)> make;
};

ExportedTable tableOf(const std::string& name, const std::string& csv)
{
    return {name, [csv](const protocols::TakeBytes& take) { take(csv); }};
}

std::vector<ExportedTable> openTables(const Export& job)
{
    return {{"answers", [&job](const protocols::TakeBytes& take) { job.answers->writeCsv(take); }},
            tableOf("participants", csvOf(participantRows(job), {"slot", "participant", "kind", "state", "protocol_version"}))};
}

/// Progress, balance and flags; rounded means under K-labels where there are any.
std::vector<ExportedTable> blindedTables(const reports::ProgressReport& report, const records::Aggregates& aggregates)
{
    std::vector<ExportedTable> tables;
    for (const auto& table : report.tables) tables.push_back(tableOf(table.name, toCsv(table)));
    if (aggregates.why.empty())
        tables.push_back(tableOf("conditions", csvOf(aggregates.rows, {"question", "condition", "n", "share", "mean"})));
    return tables;
}

void writeTables(const std::vector<ExportedTable>& tables, const std::function<fs::path(const std::string&)>& fileOf)
{
    for (const ExportedTable& table : tables) protocols::writeInPieces(fileOf(table.name), table.make, protocols::Sync::Later);
}

void writeCsvTables(const Export& job, const std::vector<ExportedTable>& tables)
{
    writeTables(tables, [&](const std::string& name) { return job.out / (name + ".csv"); });
}

/// Studies of earlier versions may not know it.
ordered_json madeWithOf(const Export& job)
{
    ordered_json made = protocols::storedOrderedJson(records::shownMadeWith(job.store, job.facts));
    return made.is_object() ? made : ordered_json::object();
}

ordered_json headOf(const Export& job)
{
    auto stamps = records::stampsOf(job.store, job.facts);
    stamps.push_back(records::displayResponseSentence(job.facts));
    ordered_json head{{"schema", "vis2hap.export/1"},
                      {"study", job.facts.name},
                      {"protocol_sha256", job.facts.protocolSha256},
                      {"blinded", job.answers == nullptr},
                      {"stamps", stamps},
                      {"participants", participantRows(job)},
                      {"preregistrations", registrationRows(job)},
                      {"acts", actRows(job)},
                      {"made_with", madeWithOf(job)},
                      {"log_head", records::headTextOf(job.store)}};
    if (const auto acts = headOfActs(job.store); acts.sequence > 0) head["acts_head"] = textOf(acts);
    return head;
}

/// The text of a whole object with a row for each answer, without holding the rows.
void writeAnswersJson(const Export& job, const protocols::TakeBytes& take)
{
    std::string head = headOf(job).dump(1);
    head.resize(head.size() - 2);  // the line end and the brace
    take(head + ",\n \"answers\": ");
    job.answers->writeJson(take);
    take("\n}\n");
}

void writeJsonExport(const Export& job)
{
    protocols::writeInPieces(
        job.out / "export.json", [&](const protocols::TakeBytes& take) { writeAnswersJson(job, take); }, protocols::Sync::Later);
}

/// "2026-11-25", UTC
std::string today()
{
    const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
    char text[40];
    std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                  static_cast<unsigned>(day.day()));
    return text;
}

/// Keeps the last part of a path; false where there is nothing to cut.
bool cutToLastPart(ordered_json& value)
{
    if (!value.is_string()) return false;
    const std::filesystem::path place(value.get<std::string>());
    const auto last = place.has_filename() ? place.filename() : place.parent_path().filename();
    if (last == place) return false;
    value = last.string();
    return true;
}

/// A protocol may hold paths of ready images and recordings, and with them the name of an account. Public ones keep the last part
/// of each.
std::string publicProtocol(const std::string& json)
{
    auto protocol = ordered_json::parse(json, nullptr, false);
    if (!protocol.is_object()) return json;
    bool isChanged = false;
    if (protocol.contains("conditions") && protocol["conditions"].is_array())
        for (auto& condition : protocol["conditions"])
            if (condition.is_object() && condition.contains("images") && cutToLastPart(condition["images"])) isChanged = true;
    if (protocol.contains("prompts") && protocol["prompts"].is_object())
        for (auto& recording : protocol["prompts"])
            if (cutToLastPart(recording)) isChanged = true;
    return isChanged ? protocol.dump(2) + "\n" : json;
}

void writeDataset(const Export& job, const ExportForm& form, const std::vector<ExportedTable>& tables,
                  const std::vector<CodebookColumn>& columns)
{
    PsychDsDataset dataset = psychDsDataset(job.store, job.facts, form, columns);
    dataset.day = today();
    protocols::makeFolders(job.out / "data", protocols::Sync::Later);
    writeTables(tables, [&](const std::string& name) { return job.out / "data" / dataFileName(job.facts.name, name); });
    write(job, "dataset_description.json", datasetDescription(dataset));
    write(job, "README.md", datasetReadme(dataset));
    write(job, "CHANGES.md", datasetChanges(dataset));
    write(job, ".psychds-ignore", datasetIgnoreList(dataset));
    if (dataset.hasRawData) protocols::makeFolders(job.out / "data/raw", protocols::Sync::Later);
    if (!dataset.hasMaterials) return;
    protocols::makeFolders(job.out / "materials", protocols::Sync::Later);
    for (const auto& version : job.store.protocolVersions())
        write(job, ("materials/protocol-" + std::to_string(version.version) + ".json").c_str(),
              form.isPublic ? publicProtocol(version.json) : version.json);
}

void writeOpen(const Export& job, const ExportForm& form)
{
    if (form.format == "json") return writeJsonExport(job);
    const auto columns = codebookOf(job.protocol, job.facts.fabrics, job.answers->columns());
    if (form.format == "psych-ds") return writeDataset(job, form, openTables(job), columns);
    writeCsvTables(job, openTables(job));
    write(job, "codebook.csv", codebookCsv(columns));
}

/// Progress, balance and flags; with the key also rounded means under K-labels, once every place of the study is finished.
void writeBlinded(const Export& job, const ExportForm& form, const records::Aggregates& aggregates)
{
    const auto report = records::blindedReport(job.store);
    const auto tables = blindedTables(report, aggregates);
    const bool hasMeans = aggregates.why.empty();
    if (form.format == "csv") return writeCsvTables(job, tables);
    if (form.format == "psych-ds") return writeDataset(job, form, tables, blindedCodebookOf(job.protocol, hasMeans));
    ordered_json json = headOf(job);
    json["progress"] = ordered_json::parse(report.results)["progress"];
    json["conditions"] = hasMeans ? aggregates.rows : ordered_json();
    if (!hasMeans) json["why"] = {{"conditions", aggregates.why}};
    write(job, "export.json", json.dump(1) + "\n");
}

void writePublicFiles(const Export& job, const ExportForm& form)
{
    write(job, "LICENSE.txt", licenceText(job.facts.name, form.licence));
    write(job, "CITATION.cff", citationText(job.facts.name, form.licence, form.authors, today()));
}

/// Throws badInput where the folder holds files. Those of an earlier export may hold what a public one leaves out, and a data
/// set consists of all files in its folder.
void requireOwnFolder(const fs::path& out, const std::string& what)
{
    if (fs::exists(out) && (!fs::is_directory(out) || !fs::is_empty(out)))
        throw protocols::badInput(
            {what + " needs a folder of its own", out.string(), "a new or an empty folder", "name another folder with --out"});
}

/// Throws badInput where nothing can be published.
void requirePublishable(const database::StudyStore& store, const ExportForm& form)
{
    const auto refuse = [&](const std::string& what, const std::string& expected) {
        throw protocols::badInput({what, store.folder().folder.string(), expected, "export without --public"});
    };
    if (!store.unblinding()) refuse("a blinded study cannot be published", "a study that is unblinded");
    if (form.format != "csv" && form.format != "psych-ds")
        refuse("--public writes tables only, not " + form.format, "--format csv or psych-ds, or none");
    if (form.withLog || form.withSamples) refuse("--public leaves out the log and the samples of fingers", "neither option");
}

/// Files in the folder that this export does not replace.
std::vector<std::string> leftFrom(const fs::path& out, const fs::path& draft)
{
    std::vector<std::string> left;
    for (const char* name : {"answers.csv", "participants.csv", "codebook.csv", "conditions.csv", "progress.csv", "balance.csv",
                             "flags.csv", "export.json", "finger_samples.csv", "log.csv", "acts.csv", "log.txt"})
        if (fs::exists(out / name) && !fs::exists(draft / name)) left.emplace_back(name);
    return left;
}

}  // namespace

WrittenExport writeExport(const database::StudyStore& store, const fs::path& out, const ExportForm& form,
                          const database::Passphrase& passphrase)
{
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
    const bool isDataset = form.format == "psych-ds";
    if (form.isPublic || isDataset) requireOwnFolder(out, form.isPublic ? "a public export" : "a data set");
    if (form.isPublic) requirePublishable(store, form);
    protocols::FolderDraft draft(out, protocols::Earlier::FilesJoined);
    std::optional<ExportedAnswers> answers;
    if (naming && form.format != "script") answers.emplace(store, protocol, *naming, form.isPublic);
    const Export job{store, facts, protocol, answers ? &*answers : nullptr, draft.path()};
    WrittenExport written;
    bool isWithoutMeans = false;
    if (form.format == "script") {
        players::writeScripts(job.store, naming ? &*naming : nullptr, job.out);
        written.removed = players::scriptsOfErased(job.store, out);
        draft.outdates({written.removed.begin(), written.removed.end()});
    } else if (blinded) {
        const auto data = form.withMeans ? records::studyData(store, passphrase) : std::nullopt;
        const auto aggregates = records::aggregatesOf(data);
        writeBlinded(job, form, aggregates);
        if (data) written.whyNoMeans = aggregates.why;
        isWithoutMeans = form.format == "csv" && !aggregates.why.empty();
    } else
        writeOpen(job, form);
    if (form.isPublic) writePublicFiles(job, form);
    const std::string beside = isDataset ? "data/raw/" : "";
    if (form.withSamples) write(job, (beside + "finger_samples.csv").c_str(), records::fingerSamplesCsv(store, {}, naming));
    if (form.withLog) records::writeExportedLog(store, draft.path() / beside);
    if (isWithoutMeans) draft.outdates({"conditions.csv"});  // of an earlier export: its means are given out no more
    written.left = leftFrom(out, draft.path());
    if (isWithoutMeans) std::erase(written.left, "conditions.csv");
    draft.putInPlace();
    return written;
}

}  // namespace study::exports
