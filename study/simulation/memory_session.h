// The session of one simulated participant without a database: the same state machine, the same rules and the same rows as
// through the store. It is for simulated participants only; nothing of it survives the process.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "study/players/hands.h"
#include "study/session/clock.h"

namespace study::simulation {

class MemorySession final : public players::Hands {
public:
    /// Enrols the participant and starts the first sitting. `plan` and `clock` must outlive the session.
    MemorySession(const session::Plan& plan, protocols::ParticipantId participant, const session::Clock& clock);

    std::optional<session::Refusal> perform(const session::EventBody& event) override;
    const session::State& state() const override { return m_state; }

    int refusals() const { return m_refusals; }
    int voidedPresentations() const;

    /// The rows as StudyStore::answers() returns them, by trial and time. `event` counts the events of this session from 1.
    std::vector<database::CurrentAnswer> answers() const;

private:
    struct Remark {
        int trial = 0, attempt = 1;
        std::optional<protocols::QuestionId> question;
        std::string text;
    };
    int attemptOf(int trial) const;
    void keep(const database::StudyStore::Append& entry);
    void keepAnswer(const database::AnswerRecord& record);
    std::string remarksOn(const database::CurrentAnswer& answer) const;

    const session::Plan& m_plan;
    protocols::ParticipantId m_participant;
    const session::Clock& m_clock;
    session::State m_state;
    std::vector<database::CurrentAnswer> m_rows;  ///< in the order of their first answers
    std::vector<Remark> m_remarks;
    std::map<int, int> m_voids;  ///< number of voided presentations of a trial
    std::int64_t m_events = 0;
    int m_refusals = 0;
};

}  // namespace study::simulation
