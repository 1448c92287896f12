#include "study/players/simulated_session.h"

#include <algorithm>
#include <string>

#include "protocols/files/errors.h"
#include "study/players/player_answers.h"
#include "study/session/preparation.h"
#include "study/session/session_record.h"

namespace study::players {

using namespace session;

namespace {

constexpr double secondsToTouch = 0.8;

class SimulatedSession {
public:
    SimulatedSession(const Judge& judge, Mishaps& mishaps, const Plan& plan, Hands& hands, VirtualClock& clock)
        : m_judge(judge), m_mishaps(mishaps), m_plan(plan), m_hands(hands), m_clock(clock)
    {
    }

    bool isOver() const
    {
        const Stage& stage = m_hands.state().stage;
        return std::holds_alternative<Finished>(stage) || std::holds_alternative<Withdrawn>(stage);
    }

    void step()
    {
        const Stage stage = m_hands.state().stage;
        m_clock.advanceSeconds(std::max(1.0, m_plan.protocol.deadTimeSeconds));
        if (m_hands.state().paused)
            act(Resumed{});
        else if (m_mishaps.withdrawsAfter(m_hands.state().answersStored))
            act(WithdrawnEvent{"simulated withdrawal"});
        else if (const auto preparation = nextOfPreparation(m_plan.protocol, stage))
            act(*preparation);
        else if (const auto* tray = std::get_if<PlacingTray>(&stage))
            lay(*tray);
        else
            ask(std::get<Presenting>(stage));
    }

private:
    void act(const EventBody& event)
    {
        if (const auto refusal = m_hands.perform(event))
            throw protocols::workFailed({"the session refuses \"" + kindOf(event) + "\": " + refusal->reason,
                                         "simulated participant", "", "report this fault with the study folder"});
    }

    void lay(const PlacingTray& tray)
    {
        // The presentation before this one was invalid. The session refuses where there is none.
        if (m_mishaps.happens(m_mishaps.rates().voids)) {
            m_hands.perform(Voided{"simulated: seen afterwards"});
            return;
        }
        act(trayReadyOf(m_plan.protocol, trialOf(tray.index).alternatives, m_plan.fabricNames));
    }

    void ask(const Presenting& presenting)
    {
        const auto& rates = m_mishaps.rates();
        if (m_mishaps.happens(rates.refusals)) actInVain(BreakEnded{});
        if (presenting.question == 0 && m_mishaps.happens(rates.voids)) return act(Voided{"simulated: wrong piece"});
        if (m_mishaps.happens(rates.pauses)) return act(Paused{});
        const auto& question = questionOf(presenting);
        if (presenting.question == 0 && !presenting.touchedAtNs) {
            m_clock.advanceSeconds(secondsToTouch);
            act(Touched{});
        }
        const auto judgement = m_judge(trialOf(presenting.index), question);
        m_clock.advanceSeconds(judgement.seconds);
        act(Answered{judgement.response, {.begunAgoNs = 0, .begunBy = BegunBy::Script}});
        if (m_mishaps.happens(rates.notes)) act(Noted{"simulated remark", true});
        if (m_mishaps.happens(rates.corrections))
            act(Corrected{question.id, m_judge(trialOf(presenting.index), question).response, "simulated: misheard"});
    }

    /// A step that no session takes now.
    void actInVain(const EventBody& event)
    {
        if (!m_hands.perform(event))
            throw protocols::workFailed({"the session takes \"" + kindOf(event) + "\", which it should refuse",
                                         "simulated participant", "", "report this fault with the study folder"});
    }

    const protocols::BlindedTrial& trialOf(int index) const { return m_plan.trials[static_cast<std::size_t>(index)]; }
    const protocols::Question& questionOf(const Presenting& presenting) const
    {
        const auto& phase = m_plan.protocol.phases[static_cast<std::size_t>(trialOf(presenting.index).phase)];
        return phase.questions[static_cast<std::size_t>(presenting.question)];
    }

    const Judge& m_judge;
    Mishaps& m_mishaps;
    const Plan& m_plan;
    Hands& m_hands;
    VirtualClock& m_clock;
};

}  // namespace

Judge judgeOf(SimulatedParticipant& participant)
{
    return [&participant](const protocols::BlindedTrial& trial, const protocols::Question& question) {
        return simulatedAnswer(participant, trial, question);
    };
}

void playSession(const Judge& judge, Mishaps& mishaps, const Plan& plan, Hands& hands, VirtualClock& clock,
                 const std::function<void(int)>& progress)
{
    SimulatedSession session(judge, mishaps, plan, hands, clock);
    while (!session.isOver()) {
        session.step();
        if (progress) progress(hands.state().answersStored);
    }
}

}  // namespace study::players
