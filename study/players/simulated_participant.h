// A simulated participant: a model of human judgement, not a table of wanted results. It computes the percept of the friction
// image that the session shows and compares it with the percept that it expects for the fabric.
//
// Expectation (expected_touch.h): the measured relief and friction of the fabric at several places. Friction grows with height
// (the paper's account of ploughing, section III.B) and is scaled by the mean coefficient. The range of the study's fabrics maps
// it to the display. A participant who knows the display learns to expect this touch. The model assumes the
// paper's account, so simulated results are no evidence for it.
//
// Judgement: distances in just-noticeable differences plus sensory noise. Q1 chooses the nearest fabric on the tray; in a lapse
// the participant guesses. Ratings fall with the distance. Each person has a shift and a spread of the ratings. Response times
// grow when the alternatives are close together.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "protocols/orders/allocation.h"
#include "protocols/random.h"
#include "study/players/evidence_accumulation.h"
#include "study/players/percept.h"
#include "study/session/given_answer.h"

namespace study::players {

struct PerceptualModel {
    double sensoryNoise = 1.0;        ///< SD of the noise on each distance, just-noticeable differences
    double lapseRate = 0.05;          ///< share of trials answered by guessing
    double slipperinessWeight = 0.4;  ///< weight of slipperiness against texture in Q1 and in ratings of realism
    double ratingFall = 5.0;          ///< distance at which a rating has fallen to 1/e of the scale
    double ratingNoise = 1.0;         ///< SD from trial to trial, scale points
    double personShift = 0.5;         ///< SD between persons of the shift of all ratings, scale points
};

/// The percept of each stimulus and the expected percept of each fabric.
struct Percepts {
    std::map<protocols::FileCode, Percept> stimuli;
    std::map<protocols::FabricId, Percept> fabrics;
    protocols::SecretKey stationKey;  ///< leads from a trial to its stimulus
    bool codesAreOpen = false;        ///< the trials are those of a simulation in memory, which name their stimuli openly

    /// The stimulus of the trial. Throws workFailed where the station key does not open its code.
    protocols::FileCode codeOf(const protocols::BlindedTrial& trial) const;
};

class SimulatedParticipant {
public:
    SimulatedParticipant(const Percepts& percepts, std::uint64_t seed, const std::string& participant, PerceptualModel model = {},
                         SpeedAccuracySetting setting = {});

    struct Judgement {
        session::GivenAnswer response;
        double seconds = 0;
    };
    /// The fabric on the tray that is nearest to the stimulus.
    Judgement match(const protocols::BlindedTrial& trial);
    /// Similarity of the stimulus and the fabric, on the protocol's scale.
    Judgement rate(const protocols::BlindedTrial& trial, const protocols::QuestionId& question,
                   const protocols::RatingScale& scale);
    /// Whether stimulus and fabric are near enough to be the same.
    Judgement compare(const protocols::BlindedTrial& trial);
    /// match() where the block of the trial instructs: a race of the pieces on the tray (evidence_accumulation.h).
    Judgement matchInstructed(const protocols::BlindedTrial& trial);
    /// compare() where the block of the trial instructs: a race of "same" and "different".
    Judgement compareInstructed(const protocols::BlindedTrial& trial);

private:
    Decision decide(const protocols::BlindedTrial& trial, std::span<const double> drifts);
    double distance(const protocols::BlindedTrial& trial, const protocols::FabricId& fabric, double slipperinessWeight) const;

    const Percepts& m_percepts;
    PerceptualModel m_model;
    protocols::Random m_random;
    double m_shift;
    SpeedAccuracySetting m_setting;  ///< of this person
    protocols::Random m_race;        ///< apart, so that answers without an instruction do not depend on it
};

}  // namespace study::players
