#include "study/leaks/seen_study.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"

namespace study::leaks {

namespace {

/// Columns that hold what a participant answered, or how long the answer took. Answers are evidence that no seal can hide.
constexpr const char* answerColumnNames[] = {"choice", "rating_tenths", "answer", "rating", "seconds", "n", "mean"};

long long whole(const std::string& text)
{
    long long number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

const TextTable* tableNamed(const std::vector<TextTable>& tables, const char* name)
{
    const auto found = std::ranges::find(tables, name, &TextTable::name);
    return found == tables.end() ? nullptr : &*found;
}

/// Each row as a function from column to cell.
template <class Take>
void eachRow(const std::vector<TextTable>& tables, const char* name, const Take& take)
{
    const TextTable* table = tableNamed(tables, name);
    if (table == nullptr) return;
    for (const auto& row : table->rows)
        take([&](const char* column) {
            const auto at = table->column(column);
            return at ? row[*at] : std::string();
        });
}

using Place = std::pair<int, int>;  ///< slot and number

/// Finds the trial that a row names.
class Trials {
public:
    explicit Trials(const SeenStudy& study)
    {
        for (std::size_t i = 0; i < study.trials.size(); ++i) {
            const SeenTrial& trial = study.trials[i];
            m_byPlace[{trial.slot, trial.number}] = i;
            m_byCode[trial.code] = i;
            if (!trial.participant.empty()) m_slots[trial.participant] = trial.slot;
        }
    }

    std::optional<std::size_t> of(const TextTable& table, const std::vector<std::string>& row) const
    {
        const auto cell = [&](const char* column) {
            const auto at = table.column(column);
            return at ? row[*at] : std::string();
        };
        if (const auto found = m_byCode.find(cell("presentation_code")); found != m_byCode.end()) return found->second;
        int slot = static_cast<int>(whole(cell("slot")));
        if (const auto found = m_slots.find(cell("participant")); found != m_slots.end()) slot = found->second;
        const std::string number = table.column("trial") ? cell("trial") : cell("number");
        const auto found = m_byPlace.find({slot, static_cast<int>(whole(number))});
        return found == m_byPlace.end() ? std::nullopt : std::optional(found->second);
    }

private:
    std::map<Place, std::size_t> m_byPlace;
    std::map<std::string, std::size_t> m_byCode;
    std::map<std::string, int> m_slots;
};

bool isAnswer(const std::string& column)
{
    return std::ranges::any_of(answerColumnNames, [&](const char* name) { return column == name; });
}

class Features {
public:
    Features(const SeenStudy& study, const std::vector<TextTable>& tables) : m_study(study), m_tables(tables), m_trials(study) {}

    std::vector<Feature> all(const std::filesystem::path& database)
    {
        for (const TextTable& table : m_tables) addTable(table);
        addEvents();
        addTimes();
        addOrder();
        addPlacesInFile(database);
        addDesign();
        addJoins();
        return std::move(m_features);
    }

private:
    std::vector<std::string> none() const { return std::vector<std::string>(m_study.trials.size()); }

    /// Leaves out what is equal in all trials of each slot: every slot has the same pieces and conditions. What only counts up is
    /// replaced by its steps.
    void add(std::string name, std::vector<std::string> values)
    {
        if (countsUp(values)) {
            name = "steps of " + name;
            values = stepsOf(values);
        }
        if (differsInSlots(values) && m_known.insert(values).second) m_features.push_back({std::move(name), std::move(values)});
    }

    bool differsInSlots(const std::vector<std::string>& values) const
    {
        std::map<int, const std::string*> first;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i].empty()) continue;
            const auto [known, isNew] = first.emplace(m_study.trials[i].slot, &values[i]);
            if (!isNew && *known->second != values[i]) return true;
        }
        return false;
    }

    /// Calls `take` with each trial and the trial before it in its slot, both with values.
    template <class Take>
    void eachPair(const std::vector<std::string>& values, const Take& take) const
    {
        std::map<int, std::size_t> before;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i].empty()) continue;
            if (const auto found = before.find(m_study.trials[i].slot); found != before.end()) take(found->second, i);
            before[m_study.trials[i].slot] = i;
        }
    }

    bool countsUp(const std::vector<std::string>& values) const
    {
        const auto isWhole = [](const std::string& text) { return text.find_first_not_of("0123456789") == std::string::npos; };
        if (!std::ranges::all_of(values, isWhole)) return false;
        bool rises = true, any = false;
        eachPair(values, [&](std::size_t from, std::size_t to) {
            any = true;
            rises = rises && whole(values[to]) > whole(values[from]);
        });
        return any && rises;
    }

    std::vector<std::string> stepsOf(const std::vector<std::string>& values) const
    {
        auto steps = none();
        eachPair(values,
                 [&](std::size_t from, std::size_t to) { steps[to] = std::to_string(whole(values[to]) - whole(values[from])); });
        return steps;
    }

    /// The first and the last row of each trial, and the number of rows.
    void addTable(const TextTable& table)
    {
        std::vector<std::vector<const std::vector<std::string>*>> rows(m_study.trials.size());
        bool any = false;
        for (const auto& row : table.rows)
            if (const auto trial = m_trials.of(table, row)) {
                rows[*trial].push_back(&row);
                any = true;
            }
        if (!any) {
            m_others.push_back(&table);
            return;
        }
        auto counts = none();
        for (std::size_t trial = 0; trial < rows.size(); ++trial) counts[trial] = std::to_string(rows[trial].size());
        add(table.name + ": number of rows", counts);
        for (std::size_t column = 0; column < table.columns.size(); ++column) {
            if (isAnswer(table.columns[column])) continue;
            auto first = none(), last = none();
            for (std::size_t trial = 0; trial < rows.size(); ++trial) {
                if (rows[trial].empty()) continue;
                first[trial] = (*rows[trial].front())[column];
                last[trial] = (*rows[trial].back())[column];
            }
            add(table.name + "." + table.columns[column], std::move(first));
            add(table.name + "." + table.columns[column] + " (last row)", std::move(last));
        }
    }

    /// The entry of each kind in the log that comes last before the first answer of a trial.
    void addEvents()
    {
        const TextTable* events = tableNamed(m_tables, "events");
        if (events == nullptr) return;
        std::map<long long, std::size_t> answers;  // number of the entry -> trial
        eachRow(m_tables, "responses", [&](const auto& cell) {
            const TextTable place{"", {"participant", "trial"}, {}};
            if (const auto trial = m_trials.of(place, {cell("participant"), cell("trial")}))
                answers[whole(cell("event"))] = *trial;
        });
        std::map<std::string, std::vector<std::vector<std::string>>> values;                   // kind and column
        std::map<std::string, std::map<std::string, const std::vector<std::string>*>> latest;  // participant, kind
        const auto participant = events->column("participant"), kind = events->column("kind"),
                   number = events->column("sequence");
        if (!participant || !kind || !number) return;
        for (const auto& row : events->rows) {
            auto& own = latest[row[*participant]];
            own[row[*kind]] = &row;
            const auto trial = answers.find(whole(row[*number]));
            if (trial == answers.end()) continue;
            for (const auto& [name, entry] : own) {
                auto& columns = values[name];
                columns.resize(events->columns.size(), none());
                for (std::size_t column = 0; column < entry->size(); ++column)
                    if (columns[column][trial->second].empty()) columns[column][trial->second] = (*entry)[column];
            }
        }
        for (auto& [name, columns] : values)
            for (std::size_t column = 0; column < columns.size(); ++column)
                if (!holdsAnswer(name, events->columns[column]))
                    add("events (" + name + ")." + events->columns[column], std::move(columns[column]));
    }

    static bool holdsAnswer(const std::string& kind, const std::string& column)
    {
        return column == "payload" && (kind == "answered" || kind == "corrected");
    }

    /// Empty where the difference of two stamps that somebody altered has no number.
    static std::string timeBetween(long long earlier, long long later)
    {
        long long difference = 0;
        return __builtin_sub_overflow(later, earlier, &difference) ? std::string() : std::to_string(difference);
    }

    /// Differences of stamps, without those that hold a participant's response time.
    void addTimes()
    {
        auto changing = none(), touching = none(), storing = none();
        std::map<std::string, long long> storedBefore;
        std::set<std::size_t> seen;
        eachRow(m_tables, "responses", [&](const auto& cell) {
            const TextTable place{"", {"participant", "trial"}, {}};
            const auto trial = m_trials.of(place, {cell("participant"), cell("trial")});
            if (!trial) return;
            auto& before = storedBefore[cell("participant")];
            if (seen.insert(*trial).second) {
                if (before > 0) changing[*trial] = timeBetween(before, whole(cell("ready_at")));
                if (!cell("touched_at").empty())
                    touching[*trial] = timeBetween(whole(cell("ready_at")), whole(cell("touched_at")));
                storing[*trial] = timeBetween(whole(cell("answered_at")), whole(cell("stored_at")));
            }
            before = whole(cell("stored_at"));
        });
        add("time from the last answer to the next image", std::move(changing));
        add("time from the image to the touch", std::move(touching));
        add("time that storing took", std::move(storing));
    }

    void addOrder()
    {
        auto forward = none(), backward = none();
        using List = std::tuple<int, int, std::string>;
        const auto listOf = [](const SeenTrial& trial) { return List{trial.slot, trial.phase, trial.instruction}; };
        std::map<List, int> counts, done;
        for (const auto& trial : m_study.trials) ++counts[listOf(trial)];
        for (std::size_t i = 0; i < m_study.trials.size(); ++i) {
            const List list = listOf(m_study.trials[i]);
            const std::string slot = std::to_string(m_study.trials[i].slot) + "/";
            forward[i] = slot + std::to_string(++done[list]);
            backward[i] = slot + std::to_string(m_study.trials[i].phase == 0 ? done[list] : counts[list] + 1 - done[list]);
        }
        add("place in the phase", std::move(forward));
        add("place in the phase, reversed", std::move(backward));
    }

    void addPlacesInFile(const std::filesystem::path& database)
    {
        const std::string bytes = protocols::readIfPossible(database).value_or("");
        auto places = none();
        for (std::size_t i = 0; i < places.size(); ++i)
            if (const auto at = bytes.find(m_study.trials[i].code); at != std::string::npos) places[i] = std::to_string(at);
        add("place in the bytes of study.db", std::move(places));
    }

    void addDesign()
    {
        const auto design = protocols::drawDesign(m_study.protocol, m_study.publicSeed);
        auto labels = none(), fabrics = none();
        for (std::size_t i = 0; i < m_study.trials.size(); ++i) {
            const auto slot = static_cast<std::size_t>(m_study.trials[i].slot) - 1;
            const auto number = static_cast<std::size_t>(m_study.trials[i].number) - 1;
            if (slot >= design.participants.size() || number >= design.participants[slot].size()) continue;
            const auto& trial = design.participants[slot][number];
            labels[i] = std::to_string(trial.label);
            const auto fabric = static_cast<std::size_t>(trial.fabric);
            if (fabric >= m_study.fabrics.size())
                throw protocols::workFailed({"the study has fewer fabrics than its protocol", "study.db",
                                             "fabrics: " + std::to_string(m_study.protocol.fabricCount), "run vis2hap verify"});
            fabrics[i] = m_study.fabrics[fabric];
        }
        add("design of the public seed: label", std::move(labels));
        add("design of the public seed: fabric", std::move(fabrics));
    }

    /// Values of other tables that a value beside a trial leads to.
    void addJoins()
    {
        constexpr std::size_t fewest = 5, shortest = 4;
        const std::size_t own = m_features.size();
        for (std::size_t f = 0; f < own; ++f)
            for (const TextTable* table : m_others)
                for (std::size_t from = 0; from < table->columns.size(); ++from) {
                    std::map<std::string, const std::vector<std::string>*> rows;
                    for (const auto& row : table->rows)
                        if (row[from].size() >= shortest) rows[row[from]] = &row;
                    if (rows.empty()) continue;
                    std::size_t found = 0;
                    for (const auto& value : m_features[f].values) found += rows.contains(value);
                    if (found < fewest) continue;
                    for (std::size_t to = 0; to < table->columns.size(); ++to) addJoin(m_features[f], *table, from, to, rows);
                }
    }

    void addJoin(const Feature& feature, const TextTable& table, std::size_t from, std::size_t to,
                 const std::map<std::string, const std::vector<std::string>*>& rows)
    {
        if (from == to) return;
        const auto kind = table.name == "events" ? table.column("kind") : std::nullopt;
        auto values = none();
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto row = rows.find(feature.values[i]);
            if (row == rows.end() || (kind && holdsAnswer((*row->second)[*kind], table.columns[to]))) continue;
            values[i] = (*row->second)[to];
        }
        const std::string name = feature.name + " = " + table.name + "." + table.columns[from] + ": " + table.columns[to];
        add(name, std::move(values));
    }

    const SeenStudy& m_study;
    const std::vector<TextTable>& m_tables;
    Trials m_trials;
    std::vector<const TextTable*> m_others;
    std::set<std::vector<std::string>> m_known;
    std::vector<Feature> m_features;
};

constexpr std::size_t mostSlots = 1'000'000;

protocols::Error notAStudy(const std::string& what)
{
    return protocols::workFailed({what, "study.db", "the trials of a study", "run vis2hap verify"});
}

/// The fabrics in the stored list. Throws workFailed where it is none, or empty.
std::vector<std::string> trayOf(const std::string& alternatives)
{
    const auto json = protocols::storedJson(alternatives);
    std::vector<std::string> tray;
    if (json.is_array())
        for (const auto& fabric : json) tray.push_back(fabric.is_string() ? fabric.get<std::string>() : fabric.dump());
    if (tray.empty()) throw notAStudy("the tray of a trial is " + alternatives);
    return tray;
}

/// Keeps the slots that seenStudy() names.
void sampleSlots(SeenStudy& study, std::size_t most)
{
    std::vector<int> slots;
    for (const SeenTrial& trial : study.trials)
        if (slots.empty() || slots.back() != trial.slot) slots.push_back(trial.slot);
    study.trialsOfStudy = study.trials.size();
    study.slotsOfStudy = slots.size();
    if (study.trialsOfStudy <= most) return;
    const std::size_t pairs = (slots.size() + 1) / 2, trialsOfPair = 2 * study.trialsOfStudy / slots.size();
    const std::size_t kept = std::clamp<std::size_t>(most / trialsOfPair, 1, pairs);
    std::set<int> sample;
    for (std::size_t i = 0; i < kept; ++i) {
        const std::size_t pair = kept == 1 ? 0 : i * (pairs - 1) / (kept - 1);
        for (std::size_t at = 2 * pair; at < std::min(2 * pair + 2, slots.size()); ++at) sample.insert(slots[at]);
    }
    std::erase_if(study.trials, [&](const SeenTrial& trial) { return !sample.contains(trial.slot); });
}

}  // namespace

bool SeenStudy::showsTruth(const SeenTrial& trial) const
{
    const auto rule = trayRuleOf(protocol.phases.at(static_cast<std::size_t>(trial.phase)).task);
    return std::holds_alternative<protocols::TrueAlone>(rule);
}

bool SeenStudy::isChoice(const SeenTrial& trial) const
{
    const auto rule = trayRuleOf(protocol.phases.at(static_cast<std::size_t>(trial.phase)).task);
    return std::holds_alternative<protocols::TrueAmongFoils>(rule);
}

SeenStudy seenStudy(const std::vector<TextTable>& database, std::size_t most)
{
    SeenStudy study;
    eachRow(database, "study", [&](const auto& cell) {
        study.protocol = protocols::keptProtocolFromJson(cell("protocol_json"), "protocol of the study", cell("program_version"));
        const std::string seed = cell("design_seed");
        std::from_chars(seed.data(), seed.data() + seed.size(), study.publicSeed);
    });
    eachRow(database, "fabrics", [&](const auto& cell) { study.fabrics.push_back(cell("id")); });
    std::map<std::string, std::string> participants;  // slot -> participant
    eachRow(database, "participants", [&](const auto& cell) {
        if (cell("state") != "withdrawn") participants[cell("slot")] = cell("id");
    });
    eachRow(database, "swatches", [&](const auto& cell) {
        const auto slot = static_cast<std::size_t>(whole(cell("slot")));
        if (slot < 1 || slot > mostSlots) throw notAStudy("a piece of fabric has the slot " + cell("slot"));
        if (study.pieceCodes.size() < slot) study.pieceCodes.resize(slot);
        study.pieceCodes[slot - 1][cell("fabric")] = cell("code");
    });
    eachRow(database, "trials", [&](const auto& cell) {
        const auto phase = whole(cell("phase"));
        if (phase < 0 || phase >= static_cast<long long>(study.protocol.phases.size()))
            throw notAStudy("a trial has the phase " + cell("phase"));
        study.trials.push_back({static_cast<int>(whole(cell("slot"))), static_cast<int>(whole(cell("number"))),
                                static_cast<int>(phase), participants[cell("slot")], cell("presentation_code"),
                                trayOf(cell("alternatives")), cell("instruction")});
    });
    if (study.trials.empty()) throw notAStudy("the study has no trials");
    if (study.fabrics.empty()) throw notAStudy("the study has no fabrics");
    std::ranges::sort(study.trials, {}, [](const SeenTrial& trial) { return Place{trial.slot, trial.number}; });
    sampleSlots(study, most);
    return study;
}

std::vector<Feature> featuresOf(const SeenStudy& study, const std::vector<TextTable>& tables,
                                const std::filesystem::path& database)
{
    return Features(study, tables).all(database);
}

}  // namespace study::leaks
