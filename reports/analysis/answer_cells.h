// The responses of a study sorted into question x condition x participant x fabric, and the unit of
// every test between conditions: the participant's mean over fabrics.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "reports/data/study_data.h"
#include "stats/kernels/block_table.h"
#include "stats/kernels/value.h"

namespace reports {

class Cells {
public:
    /// Throws workFailed for a response of something the study does not list, and for a doubled one.
    explicit Cells(const StudyData& data);

    /// Answers of a question under a condition, participants and fabrics in the order of their names, so
    /// that no result depends on the order of rows. Of one participant with the last argument.
    std::vector<const Response*> of(const std::string& question, const std::string& condition) const;
    std::vector<const Response*> of(const std::string& question, const std::string& condition,
                                    const std::string& participant) const;

    /// Participants in the order of their names: the blocks of every test.
    const std::vector<std::string>& participants() const { return m_participants; }

    /// A participant's mean rating or share correct over the fabrics answered; undefined without any.
    stats::Value participantMean(const std::string& question, const std::string& condition, const std::string& participant) const;

    /// Means of all participants who have one, in the order of participants().
    std::vector<double> participantMeans(const std::string& question, const std::string& condition) const;

    /// Participants with a mean in every condition, and their means [participants x conditions].
    struct CompleteBlocks {
        std::vector<std::string> participants;
        stats::BlockTable table;
    };
    CompleteBlocks completeBlocks(const std::string& question, const std::vector<std::string>& conditions) const;

    /// Participant x fabric blocks answered in every condition, 0 or 1.
    stats::BlockTable completeSuccesses(const std::string& question, const std::vector<std::string>& conditions) const;

    /// Means of the participants who have one under both conditions.
    struct Pairs {
        std::vector<double> a;
        std::vector<double> b;
    };
    Pairs pairs(const std::string& question, const std::string& a, const std::string& b) const;

    std::size_t answered(const std::string& question) const;

private:
    /// Of one participant: by fabric.
    using ByFabric = std::map<std::string, const Response*>;
    using ByParticipant = std::map<std::string, ByFabric>;
    const ByParticipant* find(const std::string& question, const std::string& condition) const;

    const StudyData& m_data;
    std::vector<std::string> m_participants;
    std::map<std::pair<std::string, std::string>, ByParticipant> m_cells;
};

/// Values of the responses: ratings, or 1 and 0 for right and wrong choices.
std::vector<double> valuesOf(const std::vector<const Response*>& responses);
/// Those that carry a response time.
std::vector<double> secondsOf(const std::vector<const Response*>& responses);

}  // namespace reports
