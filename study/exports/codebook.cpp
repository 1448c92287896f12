#include "study/exports/codebook.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <string_view>
#include <variant>

#include "protocols/condition.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"

namespace study::exports {

namespace {

/// Values that a column can have, where the study does not decide them.
struct FixedValues {
    const char* levels = "";           ///< separated by "; "
    std::optional<double> least = {};  ///< of numbers
    bool exceedsLeast = false;         ///< all values lie above `least`
};

constexpr FixedValues any{};
constexpr FixedValues oneOf(const char* levels) { return {levels}; }
constexpr FixedValues from(double least) { return {"", least}; }
constexpr FixedValues above(double bound) { return {"", bound, true}; }

/// What a column is. Where `values` is `any`, the protocol may add levels or ranges.
struct ColumnMeaning {
    const char* name;
    const char* type;
    const char* unit;
    FixedValues values;
    const char* meaning;
};

constexpr const char* nanoseconds = "ns on the clock of the sitting; in a public export since its first presentation";

constexpr const char* meaningOfState = "how far the session came; reports leave out who withdrew";
constexpr const char* meaningOfKind = "who answered; only human participants are evidence about people";

constexpr ColumnMeaning answerMeanings[] = {
    {"participant", "text", "", any, "id of the participant"},
    {"trial", "whole number", "", from(1), "place in the participant's running order"},
    {"question", "text", "", any, "id of the question"},
    {"fabric", "text", "", any,
     "the fabric whose rendering was shown; in a catch trial nothing was shown, and it only lay on the tray"},
    {"condition", "text", "", any, "input condition of the rendering; catch: blank glass"},
    {"alternatives", "list as JSON", "", any, "fabrics on the tray, in the order of its slots"},
    {"answer", "text", "", any, "the fabric chosen, same or different, or words; empty for ratings"},
    {"correct", "whole number", "", oneOf("0; 1"),
     "1 where the answer is right; empty where no answer is right or wrong; in catch trials right by luck only: leave them out"},
    {"rating", "number", "points of the scale", any, "on the scale of the question; empty for other questions"},
    {"seconds", "number", "s", above(0), "from the first touch, or from the question without one, to the entry of the answer"},
    {"ready_at", "whole number", nanoseconds, any,
     "when the question was ready; a later question of a presentation is ready when the one before is answered"},
    {"touched_at", "whole number", nanoseconds, any, "first touch; empty where none was stamped"},
    {"touched_by", "text", "", oneOf("display; operator"), "who stamped the first touch"},
    {"answered_at", "whole number", nanoseconds, any, "the answer was entered"},
    {"stored_at", "whole number", nanoseconds, any,
     "the latest entry of the answer was on disk: of its correction, where there is one, and then empty in a public export"},
    {"corrections", "whole number", "", from(0), "times that this answer was corrected"},
    {"voided", "whole number", "", oneOf("0; 1"), "1 where the presentation was voided, so that the answer does not count"},
    {"wall_time", "text", "ISO 8601, local time with its offset from UTC; UTC where it ends with Z", any,
     "day and time of the latest entry of the answer"},
    {"note", "text", "", any, "what the operator wrote"},
    {"touch_ended_at", "whole number", nanoseconds, any, "last time before the answer that the finger left the display"},
    {"answer_begun_at", "whole number", nanoseconds, any, "the answer began: a key, or the spoken word"},
    {"answer_begun_by", "text", "", oneOf("entry; spoken; script"), "what stamped the beginning"},
    {"entries", "whole number", "", from(2), "entries until two agreed; empty where one is enough"},
    {"response_seconds", "number", "s", any, "from the first touch to the beginning of the answer; the time that reports use"},
    {"place", "whole number", "", from(1), "place of the presentation in the order of time; those voided after an answer count"},
    {"attempt", "whole number", "", from(1), "number of this presentation of the trial; a void starts the next"},
    {"sitting", "whole number", "", from(1), "times that the session had been opened"},
    {"state", "text", "", oneOf("started; finished; withdrawn"), meaningOfState},
    {"kind", "text", "", oneOf("human; scripted; simulated"), meaningOfKind},
    {"instruction", "text", "", any, "what the block asked of the speed; empty where it asked nothing"},
    {"deadline_seconds", "number", "s", any, "deadline of the block"},
    {"late", "whole number", "", oneOf("0; 1"), "1 where the answer came after the deadline"},
    {"anchor", "text", "", oneOf("mismatched; repeated"),
     "mismatched: another fabric lay on the tray; repeated: the presentation came a second time; empty: one of the list"},
};

constexpr ColumnMeaning participantMeanings[] = {
    {"slot", "whole number", "", from(1), "running order of the study that this participant has"},
    {"participant", "text", "", any, "id of the participant"},
    {"kind", "text", "", oneOf("human; scripted; simulated"), meaningOfKind},
    {"state", "text", "", oneOf("started; finished; withdrawn"), meaningOfState},
    {"protocol_version", "whole number", "", from(1), "version of the protocol that the session followed"},
};

constexpr ColumnMeaning progressMeanings[] = {
    {"participant", "text", "", any, "id of the participant; empty where nobody has the running order"},
    {"slot", "whole number", "", from(1), "running order of the study that this participant has"},
    {"kind", "text", "", oneOf("human; scripted; simulated"), meaningOfKind},
    {"state", "text", "", oneOf("free; started; finished; withdrawn"), "how far the session came"},
    {"answers", "whole number", "", from(0), "answers that count"},
    {"expected", "whole number", "", from(0), "answers of a whole session"},
    {"voided", "whole number", "", from(0), "answers of voided presentations"},
    {"corrected", "whole number", "", from(0), "answers that were corrected"},
    {"flagged", "whole number", "", from(0), "presentations that the operator marked for a later check"},
};

constexpr ColumnMeaning balanceMeanings[] = {
    {"what", "text", "", any,
     "what the rules balance; the counts are those of other orders, because the orders of the study are sealed"},
    {"least", "whole number", "", any, "smallest count over what is balanced"},
    {"greatest", "whole number", "", any, "largest count over what is balanced"},
};

constexpr ColumnMeaning flagMeanings[] = {
    {"participant", "text", "", any, "id of the participant; empty where the flag concerns the study"},
    {"flag", "text", "", any, "name of the flag on the quality of the data"},
    {"reason", "text", "", any, "why the flag is set"},
};

constexpr ColumnMeaning aggregateMeanings[] = {
    {"question", "text", "", any, "id of the question"},
    {"condition", "text", "", any, "label of a condition, whose name is blinded"},
    {"n", "whole number", "", from(0), "answers to the question under the label, of participants who have finished"},
    {"share", "number", "", from(0), "share of right answers, rounded; empty for other questions"},
    {"mean", "number", "points of the scale", any, "mean rating, rounded; empty for other questions"},
};

/// Adds a value that is not in the list yet.
void addLevel(std::vector<std::string>& levels, const std::string& value)
{
    if (std::ranges::find(levels, value) == levels.end()) levels.push_back(value);
}

std::vector<std::string> levelsIn(std::string_view list)
{
    std::vector<std::string> levels;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find("; "), list.size());
        levels.emplace_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 2, list.size()));
    }
    return levels;
}

CodebookColumn columnOf(const char* table, const ColumnMeaning& column)
{
    const auto& [name, type, unit, values, meaning] = column;
    return {table, name, type, unit, levelsIn(values.levels), values.least, values.exceedsLeast, {}, meaning};
}

/// "1 = not at all, 2 = a little"; empty for a scale without words.
std::string wordsOf(const protocols::RatingScale& scale)
{
    std::string words;
    protocols::Tenths point = scale.min;
    for (const std::string& label : scale.labels) {
        words += (words.empty() ? "" : ", ") + protocols::shortest(point.inScaleUnits()) + " = " + label;
        point.value += scale.step.value;
    }
    return words;
}

/// Adds the levels and scales that the phases of the protocol decide.
void addFromPhases(CodebookColumn& column, const protocols::Protocol& protocol)
{
    for (const protocols::Phase& phase : protocol.phases) {
        if (column.name == "condition" && phase.catchTrials > 0) addLevel(column.levels, protocols::catchTrialId().value);
        if (column.name == "instruction")
            for (const auto& instruction : phase.instructions) addLevel(column.levels, instruction.id.value);
        for (const protocols::Question& question : phase.questions) {
            if (column.name == "question") addLevel(column.levels, question.id.value);
            if (const auto* rating = std::get_if<protocols::Rating>(&question.kind); rating && column.name == "rating")
                column.ratings.push_back(
                    {question.id, rating->scale.min.inScaleUnits(), rating->scale.max.inScaleUnits(), wordsOf(rating->scale)});
        }
    }
}

void addFromStudy(CodebookColumn& column, const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& fabrics)
{
    if (column.name == "condition")
        for (const protocols::ConditionId& condition : protocol.conditions) addLevel(column.levels, condition.value);
    if (column.name == "fabric")
        for (const protocols::FabricId& fabric : fabrics) addLevel(column.levels, fabric.value);
    addFromPhases(column, protocol);
}

/// "0; 1", "from 1", "above 0" or "Q2: 0 to 10; Q3: 1 to 2 (1 = no, 2 = yes)"
std::string valuesText(const CodebookColumn& column)
{
    using protocols::shortest;
    if (column.least) return (column.exceedsLeast ? "above " : "from ") + shortest(*column.least);
    std::string text;
    const auto add = [&](const std::string& value) { text += (text.empty() ? "" : "; ") + value; };
    for (const std::string& level : column.levels) add(level);
    for (const auto& [question, least, greatest, words] : column.ratings)
        add(question.value + ": " + shortest(least) + " to " + shortest(greatest) + (words.empty() ? "" : " (" + words + ")"));
    return text;
}

}  // namespace

bool isPrivateColumn(const std::string& column) { return column == "wall_time" || column == "note"; }

std::vector<CodebookColumn> codebookOf(const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& fabrics,
                                       const std::vector<std::string>& answerColumns)
{
    std::vector<CodebookColumn> all;
    for (const std::string& name : answerColumns) {
        const auto known = std::ranges::find_if(answerMeanings, [&](const ColumnMeaning& one) { return name == one.name; });
        assert(known != std::end(answerMeanings) && "every column of answers.csv is explained");
        all.push_back(columnOf("answers", *known));
        addFromStudy(all.back(), protocol, fabrics);
    }
    for (const ColumnMeaning& column : participantMeanings) all.push_back(columnOf("participants", column));
    return all;
}

std::vector<CodebookColumn> blindedCodebookOf(const protocols::Protocol& protocol, bool hasMeans)
{
    std::vector<CodebookColumn> all;
    const auto add = [&](const char* table, std::span<const ColumnMeaning> meanings) {
        for (const ColumnMeaning& column : meanings) all.push_back(columnOf(table, column));
    };
    add("progress", progressMeanings);
    add("balance", balanceMeanings);
    add("flags", flagMeanings);
    if (!hasMeans) return all;
    add("conditions", aggregateMeanings);
    for (CodebookColumn& column : all)
        if (column.name == "question") addFromPhases(column, protocol);
    return all;
}

std::string codebookCsv(const std::vector<CodebookColumn>& columns)
{
    std::string text = protocols::csvRow({"file", "column", "type", "unit", "values", "meaning"});
    for (const CodebookColumn& column : columns)
        text += protocols::csvRow({column.table + ".csv", column.name, column.type, column.unit,
                                   protocols::safeCell(valuesText(column)), column.meaning});
    return text;
}

}  // namespace study::exports
