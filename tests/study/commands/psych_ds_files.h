// A data set of `export --format psych-ds` as its test reads it: all files, the tables and the metadata. The parser of CSV is not
// the program's own.
#pragma once

#include <QByteArray>
#include <QString>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "protocols/files/whole_file.h"

namespace tests::support {

using nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

struct Dataset {
    QString name;
    std::map<std::string, std::string> files;  ///< path below the data set -> bytes
    json metadata;
    std::map<std::string, Rows> tables;  ///< data files with their header rows, by path

    const Rows& answers() const
    {
        const auto isPrimary = [](const auto& table) { return table.first.find("_description-") == std::string::npos; };
        return std::ranges::find_if(tables, isPrimary)->second;
    }
    QByteArray says(const std::string& what) const { return (name.toStdString() + ": " + what).c_str(); }
};

/// Empty where the table has no such column.
inline std::string cellAt(const Rows& rows, std::size_t row, const std::string& column)
{
    const auto at = std::ranges::find(rows.front(), column) - rows.front().begin();
    return at < std::ssize(rows[row]) ? rows[row][static_cast<std::size_t>(at)] : std::string();
}

inline bool isAlphanumeric(const std::string& value)
{
    return !value.empty() && std::ranges::all_of(value, [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; });
}

/// Strict RFC 4180; nothing where a quote stands in a bare cell or is never closed, or where a line is empty.
inline std::optional<Rows> csvRows(const std::string& text)
{
    Rows rows;
    std::size_t at = 0;
    while (at < text.size()) {
        if (text[at] == '\n' || text[at] == '\r') return std::nullopt;
        rows.emplace_back();
        for (bool ends = false; !ends; ++at) {
            std::string& cell = rows.back().emplace_back();
            if (at < text.size() && text[at] == '"') {
                for (++at;; ++at) {
                    if (at >= text.size()) return std::nullopt;
                    if (text[at] == '"' && text.compare(at, 2, "\"\"") != 0) break;
                    if (text[at] == '"') ++at;
                    cell += text[at];
                }
                ++at;
            } else {
                while (at < text.size() && std::string_view(",\r\n").find(text[at]) == std::string_view::npos) cell += text[at++];
                if (cell.find('"') != std::string::npos) return std::nullopt;
            }
            if (text.compare(at, 2, "\r\n") == 0) ++at;
            if (at >= text.size()) return std::nullopt;  // the last line needs its end
            if (text[at] != ',' && text[at] != '\n') return std::nullopt;
            ends = text[at] == '\n';
        }
    }
    return rows;
}

inline bool isDataFile(const std::string& path) { return path.starts_with("data/") && !path.starts_with("data/raw/"); }

inline Dataset datasetIn(const QString& name, const std::filesystem::path& folder)
{
    Dataset dataset{name, {}, {}, {}};
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            dataset.files[entry.path().lexically_relative(folder).generic_string()] = protocols::readWholeFile(entry.path());
    dataset.metadata = json::parse(dataset.files["dataset_description.json"], nullptr, false);
    for (const auto& [path, bytes] : dataset.files)
        if (isDataFile(path)) dataset.tables[path] = csvRows(bytes).value_or(Rows{{}});
    return dataset;
}

struct DataFile {
    const Dataset& dataset;
    std::string path;
    Rows rows;
};

inline std::vector<DataFile> dataFilesOf(const std::vector<Dataset>& datasets)
{
    std::vector<DataFile> files;
    for (const Dataset& dataset : datasets)
        for (const auto& [path, rows] : dataset.tables) files.push_back({dataset, path, rows});
    return files;
}

/// Every object of the metadata, with the property that holds it; empty for the root.
inline std::vector<std::pair<json, std::string>> objectsIn(const json& value, const std::string& property = {})
{
    std::vector<std::pair<json, std::string>> objects;
    const auto add = [&](const json& inner, const std::string& name) {
        for (auto& found : objectsIn(inner, name)) objects.push_back(std::move(found));
    };
    if (value.is_object()) objects.emplace_back(value, property);
    if (value.is_object())
        for (const auto& [key, inner] : value.items()) add(inner, key);
    if (value.is_array())
        for (const json& inner : value) add(inner, property);
    return objects;
}

inline std::string fileNameIn(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// The words and values of "subject-1_session-2_data.csv".
inline std::vector<std::pair<std::string, std::string>> keywordsIn(const std::string& path)
{
    std::vector<std::pair<std::string, std::string>> words;
    for (const QString& part : QString::fromStdString(fileNameIn(path)).section('_', 0, -2).split('_'))
        words.emplace_back(part.section('-', 0, 0).toStdString(), part.section('-', 1).toStdString());
    return words;
}

inline std::set<std::string> variablesOf(const Dataset& dataset)
{
    std::set<std::string> names;
    for (const json& variable : dataset.metadata["variableMeasured"]) names.insert(variable["name"].get<std::string>());
    return names;
}

inline const json* variableOf(const Dataset& dataset, const std::string& column)
{
    for (const json& variable : dataset.metadata["variableMeasured"])
        if (variable["name"] == column) return &variable;
    return nullptr;
}

/// What the cell breaks in the levels or the range of its column; empty where it fits.
inline std::string faultOfCell(const json* described, const std::string& text, const std::string& question)
{
    if (described == nullptr) return "the column is not described";
    const json& variable = *described;
    if (text.empty()) return {};
    double least = variable.value("minValue", -1e300), greatest = variable.value("maxValue", 1e300);
    std::set<std::string> levels;
    for (const json& one : variable.value("valueReference", json::array())) {
        if (one.value("@type", "") == "DefinedTerm") levels.insert(one["name"].get<std::string>());
        if (one.value("@type", "") == "QuantitativeValue" && one["name"] == question)
            least = one["minValue"], greatest = one["maxValue"];
    }
    const std::string bare = text.starts_with("'") ? text.substr(1) : text;
    if (!levels.empty()) return levels.contains(bare) ? "" : "no such level: " + bare;
    if (!variable.contains("minValue")) return {};
    const double value = QString::fromStdString(text).toDouble();
    return value >= least && value <= greatest ? "" : "out of range: " + text;
}

}  // namespace tests::support
