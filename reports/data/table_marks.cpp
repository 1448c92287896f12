#include "reports/data/table_marks.h"

#include <algorithm>
#include <initializer_list>
#include <map>

#include "protocols/files/number_text.h"
#include "protocols/protocol.h"

namespace reports {

namespace {

using protocols::CsvTable;

constexpr const char* trayColumn = "alternatives";

/// Whether the table has rows, and such a column that holds nothing but these words.
bool holdsOnly(const CsvTable& table, const char* column, std::initializer_list<std::string_view> words)
{
    const auto index = table.column(column);
    return index && !table.rows.empty() &&
           std::ranges::all_of(table.rows, [&](const auto& row) { return std::ranges::find(words, row[*index]) != words.end(); });
}

bool isList(std::string_view cell) { return cell.starts_with('[') && cell.ends_with(']'); }

/// Whether there is a column of trays, and each is a list or missing.
bool holdsTrays(const CsvTable& table)
{
    const auto index = table.column(trayColumn);
    return index && std::ranges::any_of(table.rows, [&](const auto& row) { return isList(row[*index]); }) &&
           std::ranges::all_of(table.rows,
                               [&](const auto& row) { return isList(row[*index]) || protocols::isMissing(row[*index]); });
}

/// An id without the quotes and the backslashes that JSON puts around and into it.
std::string idIn(std::string_view text)
{
    text = protocols::withoutBlanks(text);
    if (text.size() < 2 || !text.starts_with('"') || !text.ends_with('"')) return std::string(text);
    std::string id;
    for (const char c : text.substr(1, text.size() - 2))
        if (c != '\\') id += c;  // no id holds a backslash
    return id;
}

}  // namespace

bool isExport(const CsvTable& table)
{
    const auto has = [&](const char* column) { return table.column(column).has_value(); };
    const bool isStored = has("stored_at") && has("touched_by") && has("corrections");
    if (isStored && has(trayColumn) && has("answer_begun_at")) return true;
    if (isStored && has("question") && has("voided") && holdsTrays(table)) return true;
    return has("question") && namesStates(table) && holdsTrays(table);
}

bool namesAnchors(const CsvTable& table)
{
    const auto column = table.column(anchorColumn);
    return column && std::ranges::all_of(table.rows, [&](const auto& row) {
               return protocols::isMissing(row[*column]) || protocols::anchorKindNamed(row[*column]);
           });
}

bool namesStates(const CsvTable& table) { return holdsOnly(table, stateColumn, {"started", "finished", "withdrawn"}); }

bool namesKinds(const CsvTable& table) { return holdsOnly(table, kindColumn, {"human", "scripted", "simulated"}); }

bool isUsualQuestion(std::string_view name)
{
    return name.size() >= 2 && name[0] == 'Q' &&
           std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string> piecesIn(std::string_view list)
{
    std::vector<std::string> pieces;
    if (!isList(list)) return pieces;
    list = list.substr(1, list.size() - 2);
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        pieces.push_back(idIn(list.substr(0, end)));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return pieces;
}

std::set<std::string> questionsRepeatedAnew(const CsvTable& table)
{
    const auto pieces = table.column(trayColumn), anchor = table.column(anchorColumn), question = table.column("question");
    std::set<std::string> anew;
    if (!pieces || !anchor || !question) return anew;
    std::map<std::vector<std::string>, std::vector<std::string>> first;
    for (const bool isSecond : {false, true})
        for (const auto& row : table.rows) {
            const auto kind = protocols::anchorKindNamed(row[*anchor]);
            if (isSecond ? kind != protocols::AnchorKind::Repeated : kind.has_value()) continue;
            auto own = piecesIn(row[*pieces]);
            if (own.size() < 2) continue;
            std::ranges::sort(own);
            std::vector<std::string> presentation;
            for (const char* column : {"participant", "question", "fabric", "condition", "instruction"})
                if (const auto at = table.column(column)) presentation.push_back(row[*at]);
            if (!isSecond)
                first[presentation] = own;
            else if (const auto found = first.find(presentation); found != first.end() && found->second != own)
                anew.insert(row[*question]);
        }
    return anew;
}

}  // namespace reports
