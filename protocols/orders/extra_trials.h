// Draws the pieces and the places of the catch trials (blank glass) and of the repetitions of a choice phase.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "protocols/orders/counterbalancing.h"
#include "protocols/orders/running_orders.h"
#include "protocols/orders/trays.h"

namespace protocols {

/// Puts the additional presentations of a choice phase between those of the conditions, participant by participant. The others
/// keep their order. Nothing of this shows before trays.h lays pieces for all presentations together.
///
/// Pieces. Each is that of an additional presentation equally often, or once more. (If nearly every presentation is repeated, a
/// piece that is so more often than others has more repetitions.) Those that are so once more change from participant to
/// participant, evenly where the places allow it. Conditions of repeated presentations and their pieces are nearly even over the
/// study.
///
/// Places are drawn before the pieces: one in each of equal stretches, whose ends are drawn, too. So each place is about equally
/// likely, except that the first places of repetitions have few originals and are rarer. No additional presentation is first. At
/// least `blockLength` others lie between a presentation and its repetition, or half of the list where it is shorter. So a break
/// lies between them where the list has one. Pieces are exchanged for this. Where no exchange helps, the distance is smaller, and
/// one other always lies between. With three fabrics or more, neighbours have other pieces, and with three labels or more other
/// labels, where that is possible.
class ExtraTrials {
public:
    /// `blockLength`: presentations between two breaks.
    ExtraTrials(const Phase& phase, const StudySize& size, int blockLength, Random random);

    /// The next participant's list with catch trials and anchors.
    std::vector<DesignTrial> with(const std::vector<DesignTrial>& trials);

private:
    /// How often each label, fabric and rendering was repeated over the study.
    struct Repeats {
        std::vector<std::size_t> ofLabel, ofFabric, ofRendering;

        std::size_t renderingOf(const DesignTrial& trial) const;
        /// Conditions count more than fabrics, and these more than the rendering.
        std::size_t of(const DesignTrial& trial) const;
        void add(const DesignTrial& trial);
        /// The lower, the more even.
        std::size_t unevenness() const;
    };
    /// What was drawn for the participants so far.
    struct Uses {
        std::vector<std::size_t> surplus;   ///< [piece]: participants who got it once more than others
        std::vector<std::size_t> repeated;  ///< [piece]
        Repeats repeats;
    };
    using Places = std::vector<std::size_t>;  ///< ascending
    /// Places of the list, of which one is drawn.
    struct Stretch {
        std::size_t begin = 0, end = 0;
    };
    struct Stretches {
        std::vector<Stretch> caught, repeated;
    };
    /// One participant's list while it is drawn. A presentation that has no piece yet has the fabric -1.
    struct Draft {
        std::vector<DesignTrial> list;
        Places caught, repeated;
        std::size_t gap = 0;        ///< least distance of a repetition
        std::vector<int> left;      ///< [piece]: additional presentations that are due, later those without repetitions
        std::vector<int> again;     ///< [piece]: repetitions
        std::size_t exchanged = 0;  ///< pieces that are no longer those with the fewest uses
        std::size_t cost = 0;       ///< of neighbours that are alike
        Uses uses;
    };

    std::optional<Draft> bestOfSeveral(const std::vector<DesignTrial>& trials, std::size_t gap);
    std::optional<Draft> drawn(const std::vector<DesignTrial>& trials, std::size_t gap, const Stretches& stretches,
                               bool isLastResort = false);
    Stretches stretchesOf(std::size_t trials, std::size_t firstRepetition);
    std::vector<Stretch> drawStretches(std::size_t begin, std::size_t end, int count);
    Draft withoutPieces(const std::vector<DesignTrial>& trials, std::size_t gap, const Stretches& stretches);
    Places drawPlaces(const std::vector<Stretch>& stretches);
    bool dealPieces(Draft& draft, bool isLastResort);
    void dealRepetitions(Draft& draft, int rounds, bool isLastResort);
    void repeat(Draft& draft);
    std::optional<Draft> tryRepeats(const Draft& draft);
    void layCaught(Draft& draft);
    void exchangeNeighbours(Draft& draft, const Places& places) const;
    std::vector<int> shuffledFabrics();
    std::size_t costOf(const DesignTrial& trial, const DesignTrial& neighbour) const;
    std::size_t costAt(const std::vector<DesignTrial>& list, std::size_t at) const;

    Phase m_phase;
    StudySize m_size;
    std::size_t m_blockLength;
    Random m_random;
    Uses m_uses;
};

}  // namespace protocols
