#include "study/exports/codebook.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"

namespace study::exports {

namespace {

/// What a column is; `values` is filled in from the protocol where it is empty here and the study decides it.
struct ColumnMeaning {
    const char* name;
    const char* type;
    const char* unit;
    const char* values;
    const char* meaning;
};

constexpr const char* nanoseconds = "ns since the session was last opened";

constexpr ColumnMeaning columns[] = {
    {"participant", "text", "", "", "id of the participant"},
    {"trial", "whole number", "", "from 1", "place in the participant's running order"},
    {"question", "text", "", "", "id of the question"},
    {"fabric", "text", "", "", "the fabric whose rendering was shown"},
    {"condition", "text", "", "", "input condition of the rendering; catch: blank glass"},
    {"alternatives", "list as JSON", "", "", "fabrics on the tray, in the order of its slots"},
    {"answer", "text", "", "", "the fabric chosen, same or different, or words; empty for ratings"},
    {"correct", "whole number", "", "0; 1", "1 where the answer is right; empty where no answer is right or wrong"},
    {"rating", "number", "points of the scale", "", "empty for other questions"},
    {"seconds", "number", "s", "above 0", "from the first touch, or from the question without one, to the entry of the answer"},
    {"ready_at", "whole number", nanoseconds, "", "the presentation was ready"},
    {"touched_at", "whole number", nanoseconds, "", "first touch; empty where none was stamped"},
    {"touched_by", "text", "", "display; operator", "who stamped the first touch"},
    {"answered_at", "whole number", nanoseconds, "", "the answer was entered"},
    {"stored_at", "whole number", nanoseconds, "", "the answer was on disk"},
    {"corrections", "whole number", "", "from 0", "times that this answer was corrected"},
    {"voided", "whole number", "", "from 0", "earlier presentations of this trial that do not count"},
    {"wall_time", "text", "ISO 8601, UTC", "", "day and time of the answer"},
    {"note", "text", "", "", "what the operator wrote"},
    {"touch_ended_at", "whole number", nanoseconds, "", "last time before the answer that the finger left the display"},
    {"answer_begun_at", "whole number", nanoseconds, "", "the answer began: a key, or the spoken word"},
    {"answer_begun_by", "text", "", "entry; spoken; script", "what stamped the beginning"},
    {"entries", "whole number", "", "from 2", "entries until two agreed; empty where one is enough"},
    {"response_seconds", "number", "s", "", "from the first touch to the beginning of the answer; the time that reports use"},
    {"instruction", "text", "", "", "what the block asked of the speed; empty where it asked nothing"},
    {"deadline_seconds", "number", "s", "", "deadline of the block"},
    {"late", "whole number", "", "0; 1", "1 where the answer came after the deadline"},
};

constexpr ColumnMeaning participantColumns[] = {
    {"slot", "whole number", "", "from 1", "running order of the study that this participant has"},
    {"participant", "text", "", "", "id of the participant"},
    {"kind", "text", "", "human; scripted; simulated", "who answered; only human participants are evidence about people"},
    {"state", "text", "", "started; finished; withdrawn", "how far the session came"},
    {"protocol_version", "whole number", "", "from 1", "version of the protocol that the session followed"},
};

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : "; ") + word;
    return text;
}

/// Values that the study decides.
std::string valuesOf(const std::string& column, const protocols::Protocol& protocol,
                     const std::vector<protocols::FabricId>& fabrics)
{
    std::vector<std::string> values;
    const auto add = [&](const std::string& value) {
        if (std::ranges::find(values, value) == values.end()) values.push_back(value);
    };
    for (const protocols::Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions) {
            if (column == "question") add(question.id.value);
            if (const auto* rating = std::get_if<protocols::Rating>(&question.kind); rating && column == "rating")
                add(question.id.value + ": " + protocols::shortest(rating->scale.min.inScaleUnits()) + " to " +
                    protocols::shortest(rating->scale.max.inScaleUnits()));
        }
    if (column == "condition")
        for (const protocols::ConditionId& condition : protocol.conditions) add(condition.value);
    if (column == "fabric")
        for (const protocols::FabricId& fabric : fabrics) add(fabric.value);
    return joined(values);
}

}  // namespace

bool isPrivateColumn(const std::string& column) { return column == "wall_time" || column == "note"; }

std::string codebookCsv(const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& fabrics,
                        const std::vector<std::string>& answerColumns)
{
    std::string text = protocols::csvRow({"file", "column", "type", "unit", "values", "meaning"});
    const auto add = [&](const char* file, const ColumnMeaning& column, const std::string& values) {
        text += protocols::csvRow({file, column.name, column.type, column.unit, protocols::safeCell(values), column.meaning});
    };
    for (const std::string& name : answerColumns) {
        const auto known = std::ranges::find_if(columns, [&](const ColumnMeaning& one) { return name == one.name; });
        assert(known != std::end(columns) && "every column of answers.csv is explained");
        add("answers.csv", *known, *known->values != '\0' ? known->values : valuesOf(name, protocol, fabrics));
    }
    for (const ColumnMeaning& column : participantColumns) add("participants.csv", column, column.values);
    return text;
}

}  // namespace study::exports
