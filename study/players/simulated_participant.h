// A simulated participant: no table of wanted results, but a model of how a person would judge. It
// feels the friction image that the session shows and compares it with what it expects of the fabric.
//
// Expectation (expected_touch.h): the fabric's own measured relief and friction at several places, as
// friction that grows with height (the paper's account of ploughing, section III.B) scaled by the mean
// coefficient, brought to the display by the range law over the study's fabrics. That is the touch that a participant
// familiarised with the display learns to expect; it presupposes the paper's account, so simulated results are no evidence for
// it. Judgement: distances in just-noticeable differences plus noise of the senses; Q1 takes the nearest fabric on the tray, with
// lapses that guess; ratings fall with the distance, shifted and spread by the person's own use of the scale. GivenAnswer time
// grows where the alternatives lie close together.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "protocols/allocation.h"
#include "protocols/random.h"
#include "study/players/hands.h"
#include "study/players/percept.h"
#include "study/session/clock.h"

namespace study::players {

struct PerceptualModel {
    double sensoryNoise = 1.0;        ///< SD of the noise on each distance, just-noticeable differences
    double lapseRate = 0.05;          ///< share of trials answered by guessing
    double slipperinessWeight = 0.4;  ///< of slipperiness against texture in Q1 and in questions of realism
    double ratingFall = 5.0;          ///< distance at which a rating has fallen to 1/e of the scale
    double ratingNoise = 1.0;         ///< SD from trial to trial, scale points
    double personShift = 0.5;         ///< SD of a person's own shift of all ratings, scale points
};

/// What is felt of each stimulus and expected of each fabric.
struct Percepts {
    std::map<protocols::FileCode, Percept> stimuli;
    std::map<protocols::FabricId, Percept> fabrics;
};

class SimulatedParticipant {
public:
    SimulatedParticipant(const Percepts& percepts, std::uint64_t seed, const std::string& participant,
                         PerceptualModel model = {});

    struct Judgement {
        session::GivenAnswer response;
        double seconds = 0;
    };
    /// Which fabric on the tray the stimulus is most like.
    Judgement match(const protocols::BlindedTrial& trial);
    /// How like the fabric the stimulus is, on the protocol's scale.
    Judgement rate(const protocols::BlindedTrial& trial, const protocols::QuestionId& question,
                   const protocols::RatingScale& scale);
    /// Whether the fabric on the tray is the one that is felt.
    Judgement compare(const protocols::BlindedTrial& trial);

private:
    double distance(const protocols::FileCode& code, const protocols::FabricId& fabric, double slipperinessWeight) const;

    const Percepts& m_percepts;
    PerceptualModel m_model;
    protocols::Random m_random;
    double m_shift;
};

/// Lets the participant answer through the session to its end.
void playSimulated(SimulatedParticipant& participant, const session::Plan& plan, Hands& hands, session::VirtualClock& clock,
                   const std::function<void(int)>& progress = {});

}  // namespace study::players
