#include "reports/data/answers_csv.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "protocols/condition.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"

namespace reports {
namespace {

struct QuestionColumns {
    QuestionInfo info;
    std::optional<std::size_t> value;  ///< _correct or the rating
    std::optional<std::size_t> seconds;
    std::optional<std::size_t> answer;
};

bool isQuestionName(const std::string& name)
{
    return name.size() >= 2 && name[0] == 'Q' &&
           std::all_of(name.begin() + 1, name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "Q1_seconds" -> "Q1" for the suffix "_seconds".
std::optional<std::string> stem(const std::string& name, const std::string& suffix)
{
    if (name.size() <= suffix.size() || !name.ends_with(suffix)) return std::nullopt;
    return name.substr(0, name.size() - suffix.size());
}

class Builder {
public:
    Builder(const std::filesystem::path& file, const AnswersCsvOptions& options)
        : m_where(file.string()), m_options(options), m_table(protocols::readCsvTable(file))
    {
        m_data.name = file.stem().string();
        m_data.blinded = false;
        m_data.alternatives = options.alternatives;
        m_data.protocolSha256 = options.protocolSha256;
    }

    StudyData build()
    {
        readProtocol();
        readHeader();
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) readRow(row);
        if (m_data.responses.empty()) fail("there are no answers", m_where, "at least one row with an answer");
        finish();
        return std::move(m_data);
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& place, const std::string& expected) const
    {
        throw protocols::badInput({what, place, expected, ""});
    }

    std::string headerRow() const { return m_where + ", header row"; }
    std::string nameOf(std::size_t row) const { return protocols::rowName(m_table, row); }
    const std::string& cell(std::size_t row, std::size_t column) const { return m_table.rows[row][column]; }

    void readProtocol()
    {
        if (!m_options.protocol) return;
        const protocols::Protocol& protocol = *m_options.protocol;
        m_data.name = protocol.name;
        m_data.equivalenceBounds = protocol.equivalenceBounds;
        for (const protocols::Phase& phase : protocol.phases) {
            if (const auto* choice = std::get_if<protocols::ForcedChoice>(&phase.task))
                m_data.alternatives = choice->alternatives;
            if (const auto* rating = std::get_if<protocols::Rating>(&phase.task)) {
                m_data.scaleMin = rating->scale.min.inScaleUnits();
                m_data.scaleMax = rating->scale.max.inScaleUnits();
            }
        }
    }

    std::string textOf(const std::string& question) const
    {
        if (m_options.protocol)
            for (const protocols::Phase& phase : m_options.protocol->phases)
                for (const protocols::Question& known : phase.questions)
                    if (known.id.value == question) return known.text;
        return {};
    }

    bool isKnownQuestion(const std::string& name) const { return isQuestionName(name) || !textOf(name).empty(); }

    QuestionColumns& question(const std::string& id)
    {
        for (QuestionColumns& known : m_questions)
            if (known.info.id == id) return known;
        m_questions.push_back({{id, textOf(id), false}, {}, {}, {}});
        return m_questions.back();
    }

    void readHeader()
    {
        for (const char* needed : {"participant", "fabric", "condition"})
            if (!m_table.column(needed))
                fail("the column \"" + std::string(needed) + "\" is missing", headerRow(),
                     "participant,fabric,condition and the questions, such as Q1_correct,Q2,Q3,Q4");
        for (std::size_t i = 0; i < m_table.columns.size(); ++i) readColumn(m_table.columns[i], i);
        for (const QuestionColumns& known : m_questions)
            if (!known.value)
                fail("the question " + known.info.id + " has no answers", headerRow(),
                     "a column " + known.info.id + "_correct or " + known.info.id);
        if (m_questions.empty()) fail("there is no question", headerRow(), "columns such as Q1_correct,Q2,Q3,Q4");
        std::stable_sort(m_questions.begin(), m_questions.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
        for (const QuestionColumns& known : m_questions) m_data.questions.push_back(known.info);
    }

    void readColumn(const std::string& name, std::size_t index)
    {
        if (name == "participant" || name == "fabric" || name == "condition") return;
        if (const auto id = stem(name, "_correct")) {
            question(*id).value = index;
            question(*id).info.isChoice = true;
        } else if (const auto timed = stem(name, "_seconds")) {
            question(*timed).seconds = index;
        } else if (const auto answered = stem(name, "_answer")) {
            question(*answered).answer = index;
        } else if (isKnownQuestion(name)) {
            if (question(name).value)
                fail("the question " + name + " has two columns", headerRow(), "either " + name + " or " + name + "_correct");
            question(name).value = index;
        } else {
            fail("the column \"" + name + "\" is unknown", headerRow(),
                 "participant, fabric, condition, Qn, Qn_correct, Qn_seconds or Qn_answer");
        }
    }

    static void remember(std::vector<std::string>& names, const std::string& name)
    {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }

    std::string named(std::size_t row, const char* column) const
    {
        const std::string& name = cell(row, *m_table.column(column));
        if (protocols::isMissing(name)) fail("the " + std::string(column) + " is empty", nameOf(row), "a name");
        return name;
    }

    static std::string conditionOf(std::string name)
    {
        std::string spelled = name;
        std::replace(spelled.begin(), spelled.end(), '+', '&');
        const auto all = protocols::allConditions();
        const bool known = std::any_of(all.begin(), all.end(), [&](const auto& condition) { return condition.id == spelled; });
        return known ? spelled : name;
    }

    void readRow(std::size_t row)
    {
        const std::string participant = named(row, "participant");
        const std::string fabric = named(row, "fabric");
        const std::string condition = conditionOf(named(row, "condition"));
        if (!m_seen.insert({participant, fabric, condition}).second)
            fail("the answers of " + participant + " to " + fabric + " under " + condition + " occur twice",
                 nameOf(row), "one row a participant, fabric and condition");
        remember(m_data.participants, participant);
        remember(m_data.fabrics, fabric);
        remember(m_data.conditions, condition);
        for (const QuestionColumns& columns : m_questions) {
            Response response{participant, fabric, condition, columns.info.id, {}, {}, {}, {}, {}};
            if (readAnswer(row, columns, response)) m_data.responses.push_back(response);
        }
    }

    bool readAnswer(std::size_t row, const QuestionColumns& columns, Response& response)
    {
        const auto number = protocols::numberOrMissing(m_table, row, *columns.value);
        if (!number) return false;
        const std::string place = nameOf(row) + ", column " + m_table.columns[*columns.value];
        if (columns.info.isChoice) {
            if (*number != 0 && *number != 1)
                fail("\"" + cell(row, *columns.value) + "\" is neither right nor wrong", place, "0 or 1");
            response.correct = *number == 1;
        } else {
            if (m_options.protocol && (*number < m_data.scaleMin || *number > m_data.scaleMax))
                fail("the rating " + cell(row, *columns.value) + " is outside the scale", place,
                     "a number of the protocol's scale");
            m_smallest = std::min(m_smallest, *number);
            m_largest = std::max(m_largest, *number);
            response.rating = *number;
        }
        if (columns.seconds) response.seconds = protocols::numberOrMissing(m_table, row, *columns.seconds);
        if (columns.answer && !protocols::isMissing(cell(row, *columns.answer))) response.answer = cell(row, *columns.answer);
        return true;
    }

    void finish()
    {
        if (!m_options.protocol) {
            m_data.scaleMin = std::min(m_data.scaleMin, m_smallest);
            m_data.scaleMax = std::max(m_data.scaleMax, m_largest);
        } else {
            for (const protocols::PlannedContrast& contrast : m_options.protocol->planned)
                m_data.planned.emplace_back(contrast.a.value, contrast.b.value);
        }
        m_data.expectedResponses =
            m_data.participants.size() * m_data.fabrics.size() * m_data.conditions.size() * m_data.questions.size();
    }

    std::string m_where;
    const AnswersCsvOptions& m_options;
    protocols::CsvTable m_table;
    StudyData m_data;
    std::vector<QuestionColumns> m_questions;
    std::set<std::tuple<std::string, std::string, std::string>> m_seen;
    double m_smallest = 0;
    double m_largest = 0;
};

}  // namespace

StudyData readAnswersCsv(const std::filesystem::path& file, const AnswersCsvOptions& options)
{
    if (options.alternatives < 2)
        throw protocols::badInput({"a choice among " + std::to_string(options.alternatives), "--alternatives", "2 or more", ""});
    return Builder(file, options).build();
}

}  // namespace reports
