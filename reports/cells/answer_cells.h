// The answers of a study sorted into question x condition x participant x fabric, and the unit of every test between
// conditions: the participant's mean over fabrics. Repeated answers of a cell are averaged first, so that a fabric that was
// touched more often does not weigh more. Conditions are compared on the answers that the participant gave under all of them: on
// the same fabrics, and in the same repetitions (see common_units.h). So a missing answer does not turn a difference of fabrics
// or of repetitions into one of conditions.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "reports/data/study_data.h"
#include "stats/kernels/block_table.h"
#include "stats/kernels/value.h"

namespace reports {

/// The answers in a participant's means, where some are missing.
enum class AnswersOfMeans {
    Common,  ///< those in units that have an answer under every condition that is compared (see common_units.h)
    All,     ///< all that were given under a condition: conditions may then differ by their fabrics and repetitions
};

/// Keeps a reference to the data, which must outlive it.
class AnswerCells {
public:
    /// Throws workFailed for an answer that names something unknown to the study or does not fit its question's kind, and for
    /// a second answer of one repetition in the same cell.
    explicit AnswerCells(const StudyData& data);

    /// Answers to a question under a condition. Participants, fabrics and repetitions stand in the order of their names, so that
    /// no result depends on the order of rows.
    std::vector<const StudyResponse*> of(const std::string& question, const std::string& condition) const;
    /// The answers of one participant.
    std::vector<const StudyResponse*> of(const std::string& question, const std::string& condition,
                                         const std::string& participant) const;
    /// All answers of one participant to a question, in the order of the conditions.
    std::vector<const StudyResponse*> ofParticipant(const std::string& question, const std::string& participant) const;

    /// Participants in the order of their names: the blocks of every test.
    const std::vector<std::string>& participants() const { return m_participants; }

    /// One participant x fabric under a condition.
    struct CellMean {
        std::size_t participant;  ///< place in participants()
        const StudyResponse* first;
        double mean;  ///< over the repetitions
        std::size_t answers;
    };
    /// Cells with a number, in the order of participants and fabrics.
    std::vector<CellMean> cellMeans(const std::string& question, const std::string& condition) const;

    /// A participant's mean rating, or share correct, over the fabrics answered; undefined without answers.
    const stats::Value& participantMean(const std::string& question, const std::string& condition,
                                        const std::string& participant) const;

    /// Means of all participants who have one, in the order of participants().
    std::vector<double> participantMeans(const std::string& question, const std::string& condition) const;

    /// Most answers to a question by one participant x fabric x condition: those of a full cell.
    std::size_t mostAnswers(const std::string& question) const { return m_mostAnswers[m_questionPlaces.at(question)]; }

    /// Whether a participant answered under two conditions, but not the same fabrics and repetitions.
    bool haveUnequalAnswers(const std::string& question) const;

    /// Participants with a mean in every condition, and their means [participants x conditions].
    struct CompleteBlocks {
        std::vector<std::string> participants;
        stats::BlockTable table;
    };
    CompleteBlocks completeBlocks(const std::string& question, AnswersOfMeans over = AnswersOfMeans::Common) const;

    /// Blocks of participant x fabric x repetition that are answered in every condition: 1 correct, 0 wrong. Repetitions without
    /// common names are counted.
    stats::BlockTable completeSuccesses(const std::string& question) const;

    /// Means of the participants who have them under both conditions.
    struct PairedMeans {
        std::vector<double> a;
        std::vector<double> b;
    };
    PairedMeans pairedMeans(const std::string& question, const std::string& a, const std::string& b,
                            AnswersOfMeans over = AnswersOfMeans::Common) const;

    /// Number of answers to a question.
    std::size_t answered(const std::string& question) const;

private:
    using Places = std::unordered_map<std::string, std::size_t>;
    /// A run of answers of one question, condition and participant.
    std::size_t runOf(std::size_t question, std::size_t condition, std::size_t participant) const
    {
        return (question * m_data.conditions.size() + condition) * m_participants.size() + participant;
    }
    std::size_t firstRun(const std::string& question, const std::string& condition) const;
    std::vector<CellMean> cellsOfRun(std::size_t run, std::size_t participant) const;

    struct FabricMean {
        std::size_t fabric;  ///< place among the fabrics in the order of their names
        double mean;
    };
    std::span<const FabricMean> fabricsIn(std::size_t run) const;
    bool haveSameFabrics(std::size_t run, std::size_t other) const;
    /// Means of runs of one participant; empty where one is missing. Common means take whole cells.
    std::vector<double> meansOfRuns(std::span<const std::size_t> runs, AnswersOfMeans over) const;

    const StudyData& m_data;
    std::vector<std::string> m_participants;
    Places m_participantPlaces, m_conditionPlaces, m_questionPlaces;
    std::vector<const StudyResponse*> m_answers;  ///< sorted by question, condition, participant, fabric, repetition
    std::vector<std::size_t> m_starts;            ///< first answer of each run, and their end
    std::vector<stats::Value> m_means;            ///< by run
    std::vector<FabricMean> m_cells;              ///< sorted like the answers
    std::vector<std::size_t> m_cellStarts;        ///< first cell of each run, and their end
    std::vector<std::size_t> m_mostAnswers;       ///< by question, in one participant x fabric x condition
};

/// The number of an answer: a rating, or 1 for a right and 0 for a wrong choice. Words have none and are left out.
std::vector<double> valuesOf(const std::vector<const StudyResponse*>& responses);

/// Number of right choices among these values.
std::size_t correctAmong(const std::vector<double>& values);

}  // namespace reports
