// The unit of every comparison between conditions: what one participant answered about one fabric in one repetition, under all of
// the conditions. A missing answer leaves out its partners under the other conditions, so that a difference of fabrics,
// repetitions or instructions does not look like one of conditions.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "stats/kernels/value.h"

namespace reports {

/// What matches the answers of a participant x fabric between conditions, where a cell holds several.
enum class UnitMark {
    Repetition,   ///< the name of repetition and session
    Instruction,  ///< the instruction; several answers under it are one unit
    None,         ///< nothing: all answers about a fabric are one unit
};

/// Under which conditions a unit needs an answer.
enum class UnitNeeds {
    EveryCondition,     ///< under all that are compared
    AnsweredCondition,  ///< under all that the participant answered for the fabric: models fill such gaps
};

/// Whether an answer counts; empty: every answer does.
using CountsAnswer = std::function<bool(const StudyResponse&)>;

/// Answers of one participant, by condition; in the order of fabrics and repetitions.
using AnswersByCondition = std::vector<std::vector<const StudyResponse*>>;

/// Keeps a reference to the cells, which must outlive it.
class CommonUnits {
public:
    /// The mark is the finest one that the conditions share. Names of repetitions may be mere row numbers, and a session may
    /// belong to one condition. They are shared if they meet: some participant answered a fabric in one of them under all
    /// conditions. And full cells, which hold as many answers as any cell of the question, must not contradict: those of one
    /// participant and fabric have the same names. Instructions only must not contradict. So full cells never lose an answer.
    CommonUnits(const AnswerCells& cells, std::string question, std::vector<std::string> conditions,
                UnitNeeds needs = UnitNeeds::EveryCondition);

    UnitMark mark() const { return m_mark; }

    /// The answers in common units.
    AnswersByCondition answers(const std::string& participant, const CountsAnswer& counts = {}) const;
    /// The same with equally many of a unit under each condition; further ones are left out.
    AnswersByCondition pairedAnswers(const std::string& participant, const CountsAnswer& counts = {}) const;

    /// One fabric with common units.
    struct FabricMeans {
        std::string fabric;
        std::vector<stats::Value> means;  ///< by condition, over the common units; undefined without an answer
    };
    /// In the order of the fabrics' names.
    std::vector<FabricMeans> fabrics(const std::string& participant) const;

    /// The answers behind the means of a fabric: by condition its units, which count equally, with their answers.
    struct FabricUnits {
        std::string fabric;
        std::vector<std::vector<std::vector<const StudyResponse*>>> units;
    };
    /// In the order of the fabrics' names.
    std::vector<FabricUnits> units(const std::string& participant) const;

    /// Means over these fabrics, by condition; empty where no unit is common. Only for UnitNeeds::EveryCondition.
    std::vector<double> means(const std::string& participant) const;

    /// Whether the participant has an answer that is in no common unit.
    bool leavesOutAnswers(const std::string& participant) const;

private:
    AnswersByCondition allAnswers(const std::string& participant) const;
    AnswersByCondition commonAnswers(const std::string& participant, const CountsAnswer& counts, bool isPaired) const;
    bool isShared(UnitMark mark) const;

    const AnswerCells& m_cells;
    std::string m_question;
    std::vector<std::string> m_conditions;
    UnitNeeds m_needs;
    UnitMark m_mark = UnitMark::None;
};

/// Means over fabrics, by condition; empty where some condition has none.
std::vector<double> meansOverFabrics(const std::vector<CommonUnits::FabricMeans>& fabrics);

}  // namespace reports
