#include "study/exports/psych_ds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "reports/text/plain_words.h"
#include "study/records/display_response_record.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"

namespace study::exports {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t longestStem = 40, hashDigits = 8;
constexpr std::string_view hexDigits = "0123456789abcdef";

bool isAsciiLetterOrDigit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

/// Whether the value ends as that of a changed name does: "x" and a hash.
bool endsLikeAHash(const std::string& value)
{
    if (value.size() <= hashDigits || value[value.size() - hashDigits - 1] != 'x') return false;
    return value.find_first_not_of(hexDigits, value.size() - hashDigits) == std::string::npos;
}

/// Whole numbers without a decimal point.
ordered_json jsonNumber(double value)
{
    if (value == std::floor(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
    return value;
}

/// What the specification's programs take as the data dictionary: one column with unit, range and levels.
ordered_json propertyOf(const CodebookColumn& column)
{
    const std::string above = column.exceedsLeast ? ", above " + jsonNumber(*column.least).dump() : "";
    ordered_json property{
        {"@type", "PropertyValue"}, {"name", column.name}, {"description", column.meaning + " (" + column.type + above + ")"}};
    if (!column.unit.empty()) property["unitText"] = column.unit;
    if (column.least) property["minValue"] = jsonNumber(*column.least);
    ordered_json references = ordered_json::array();
    for (const std::string& level : column.levels) references.push_back({{"@type", "DefinedTerm"}, {"name", level}});
    for (const auto& [question, least, greatest, words] : column.ratings) {
        references.push_back({{"@type", "QuantitativeValue"},
                              {"name", question.value},
                              {"minValue", jsonNumber(least)},
                              {"maxValue", jsonNumber(greatest)}});
        if (!words.empty()) references.back()["description"] = words;
    }
    if (!column.ratings.empty()) {
        property["minValue"] = jsonNumber(std::ranges::min(column.ratings, {}, &RatedQuestion::least).least);
        property["maxValue"] = jsonNumber(std::ranges::max(column.ratings, {}, &RatedQuestion::greatest).greatest);
    }
    if (!references.empty()) property["valueReference"] = references;
    return property;
}

/// Each name once: tables share columns such as "participant".
ordered_json propertiesOf(const std::vector<CodebookColumn>& columns)
{
    ordered_json properties = ordered_json::array();
    std::set<std::string> described;
    for (const CodebookColumn& column : columns)
        if (described.insert(column.name).second) properties.push_back(propertyOf(column));
    return properties;
}

/// Text that Markdown shows as it is, on one line.
std::string markdown(const std::string& text)
{
    std::string safe;
    for (const char c : protocols::printable(text)) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else {
            if (std::string_view("\\`*_[]#|~").find(c) != std::string_view::npos) safe += '\\';
            safe += c;
        }
    }
    return safe;
}

/// "3 participants (2 human, 1 simulated)"
std::string participantsText(const std::vector<database::Enrolment>& enrolments)
{
    std::map<std::string, std::size_t> kinds;
    for (const auto& enrolment : enrolments) ++kinds[nameOf(enrolment.kind)];
    std::string text;
    for (const auto& [kind, count] : kinds) text += (text.empty() ? " (" : ", ") + std::to_string(count) + " " + kind;
    return reports::counted(enrolments.size(), "participant") + (text.empty() ? "" : text + ")");
}

/// Those whose answers the data set may hold: nobody whose answers were erased, in public nobody who withdrew.
std::vector<database::Enrolment> answeringIn(const database::StudyStore& store, bool isPublic)
{
    auto enrolments = store.enrolments();
    const auto erased = records::erasedParticipants(store);
    std::erase_if(enrolments, [&](const database::Enrolment& one) {
        return one.state == database::SlotState::Withdrawn && (isPublic || erased.contains(one.participant));
    });
    return enrolments;
}

std::string questionsOf(const protocols::Protocol& protocol)
{
    std::vector<std::string> ids;
    for (const protocols::Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions)
            if (std::ranges::find(ids, question.id.value) == ids.end()) ids.push_back(question.id.value);
    return (ids.size() == 1 ? "the question " : "the questions ") + reports::listed(ids);
}

std::string describedAnswers(const database::StudyStore& store, const database::StudyFacts& facts, bool isPublic)
{
    return "Answers in the study \"" + facts.name + "\" by " + participantsText(answeringIn(store, isPublic)) +
           ". In each presentation a participant feels a rendering of a fabric on a haptic display. The participant then "
           "answers " +
           questionsOf(records::protocolOf(facts)) + ". Only human participants are evidence about people.";
}

std::string describedProgress(const database::StudyStore& store, const database::StudyFacts& facts, bool hasMeans)
{
    return "Progress of the study \"" + facts.name + "\" with " + participantsText(store.enrolments()) +
           ". The study is blinded, so these tables hold no single answer, no fabric and no condition." +
           (hasMeans ? " Rounded means stand under labels that hide the conditions. They are over all places of the "
                       "study, which are finished."
                     : "");
}

/// Words of the operator are left out of public exports and of blinded ones.
std::vector<std::string> changesOf(const database::StudyStore& store, bool withWords)
{
    std::vector<std::string> lines;
    for (const auto& version : store.protocolVersions())
        if (version.version > 1)
            lines.push_back("The study took over version " + std::to_string(version.version) + " of its protocol" +
                            (withWords ? " (" + version.wallTime + "): " + version.why : "."));
    return lines;
}

const char* contentOf(const std::string& table)
{
    if (table == "answers") return "the answers, one row an answer";
    if (table == "participants") return "the participants, one row a participant";
    if (table == "progress") return "the progress, one row a running order";
    if (table == "balance") return "the balance of other running orders that the same rules gave; those of the study are sealed";
    if (table == "flags") return "flags on the quality of the data";
    return "rounded means over all participants, one row a question and label";
}

std::string fileTable(const PsychDsDataset& dataset)
{
    std::string text = "| file | content |\n|---|---|\n";
    const auto add = [&](const std::string& file, const std::string& content) {
        text += "| `" + file + "` | " + content + " |\n";
    };
    for (const std::string& table : dataset.tables) add("data/" + dataFileName(dataset.study, table), contentOf(table));
    add("dataset_description.json", "the metadata: meaning, unit, range and levels of each column");
    add("CHANGES.md", "the history of this data set");
    if (dataset.hasMaterials) add("materials/", "the protocol of the study, one file a version");
    if (dataset.hasRawData) add("data/raw/", "what the program recorded beside the answers, as it was recorded");
    if (dataset.isPublic) {
        add("LICENSE.txt", "the licence");
        add("CITATION.cff", "how to cite the data");
    }
    return text;
}

}  // namespace

std::string keywordValue(const std::string& name)
{
    std::string value;
    bool beginsWord = false;
    for (const char c : name) {
        if (isAsciiLetterOrDigit(c)) value += beginsWord && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        beginsWord = !isAsciiLetterOrDigit(c);
    }
    const bool isWhole = value == name && !value.empty() && value.size() <= longestStem;
    if (isWhole && !endsLikeAHash(value)) return value;
    return value.substr(0, longestStem) + "x" + protocols::sha256(name).substr(0, hashDigits);
}

std::string dataFileName(const std::string& study, const std::string& table)
{
    assert(std::ranges::all_of(table, [](char c) { return c >= 'a' && c <= 'z'; }) && "a keyword has letters and digits only");
    return "study-" + keywordValue(study) + (table == "answers" ? "" : "_description-" + table) + "_data.csv";
}

PsychDsDataset psychDsDataset(const database::StudyStore& store, const database::StudyFacts& facts, const ExportForm& form,
                              const std::vector<CodebookColumn>& columns)
{
    PsychDsDataset dataset;
    dataset.study = facts.name;
    dataset.columns = columns;
    for (const CodebookColumn& column : columns)
        if (dataset.tables.empty() || dataset.tables.back() != column.table) dataset.tables.push_back(column.table);
    const bool hasAnswers = dataset.tables.front() == "answers";
    dataset.description = hasAnswers ? describedAnswers(store, facts, form.isPublic)
                                     : describedProgress(store, facts, dataset.tables.back() == "conditions");
    if (hasAnswers)
        dataset.rowKey =
            "`participant`, `trial` and `question` name one row of the answers, among the rows where `voided` is 0. Reports "
            "leave out voided rows, and rows whose `state` is withdrawn.";
    dataset.limits =
        records::stampsOf(store, facts, form.isPublic ? records::ProgramFiles::LeftOut : records::ProgramFiles::Named);
    dataset.limits.push_back(form.isPublic ? records::publicDisplayResponseSentence(facts)
                                           : records::displayResponseSentence(facts));
    dataset.changes = changesOf(store, hasAnswers && !form.isPublic);
    dataset.logHead = records::headTextOf(store);
    dataset.hasMaterials = hasAnswers;
    dataset.hasRawData = form.withLog || form.withSamples;
    dataset.isPublic = form.isPublic;
    dataset.licence = form.licence;
    dataset.authors = form.authors;
    return dataset;
}

std::string datasetDescription(const PsychDsDataset& dataset)
{
    std::string description = dataset.description;
    for (const std::string& limit : dataset.limits) description += " " + limit;
    ordered_json json{{"@context", "https://schema.org/"},
                      {"@type", "Dataset"},
                      {"name", dataset.study},
                      {"description", description},
                      {"schemaVersion", std::string("Psych-DS ") + psychDsVersion},
                      {"identifier", dataset.logHead},
                      {"keywords", {"haptics", "touch", "fabrics"}}};
    if (dataset.isPublic) {
        json["license"] = "https://spdx.org/licenses/" + dataset.licence + ".html";
        json["citation"] = "CITATION.cff";
        json["datePublished"] = dataset.day;
    }
    for (const std::string& author : dataset.authors) json["author"].push_back({{"@type", "Person"}, {"name", author}});
    json["variableMeasured"] = propertiesOf(dataset.columns);
    std::string text;
    for (const char c : json.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n")
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

std::string datasetReadme(const PsychDsDataset& dataset)
{
    std::string text = "# " + markdown(dataset.study) + "\n\n" + markdown(dataset.description) + "\n\n## Files\n\n" +
                       fileTable(dataset) + "\n## Rows and cells\n\n" + (dataset.rowKey.empty() ? "" : dataset.rowKey + "\n") +
                       "An empty cell is a missing value. Files are in UTF-8, with commas and decimal points.\n"
                       "Text that a spreadsheet would run as a formula has an apostrophe in front.\n";
    if (dataset.isPublic) text += "Days, notes and words of participants are left out, and the answers of those who withdrew.\n";
    if (!dataset.limits.empty()) text += "\n## Limits\n\n";
    for (const std::string& limit : dataset.limits) text += "- " + markdown(limit) + "\n";
    return text + "\n## Standard\n\nThis folder follows Psych-DS " + psychDsVersion + " (https://psych-ds.github.io).\n";
}

std::string datasetChanges(const PsychDsDataset& dataset)
{
    std::string text =
        "# Changes\n\nAdd a heading and lines for each later version of this data set; the newest comes first.\n\n## " +
        dataset.day + "\n\n- `vis2hap export` wrote the data set. The head of the study's log was `" + dataset.logHead + "`.\n";
    for (const std::string& change : dataset.changes) text += "- " + markdown(change) + "\n";
    return text;
}

std::string datasetIgnoreList(const PsychDsDataset& dataset)
{
    return std::string("# Files that Psych-DS does not specify\ndata/raw/\n") +
           (dataset.isPublic ? "LICENSE.txt\nCITATION.cff\n" : "");
}

}  // namespace study::exports
