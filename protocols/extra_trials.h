// Draws the one fabric on the tray of a same/different phase, and the places of catch trials (blank glass) and of anchors.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/running_orders.h"
#include "protocols/trays.h"

namespace protocols {

/// The fabric on the tray, [participant][position]. It is the rendering's own in half of the presentations: per label x fabric
/// over participants, per participant x label, and per participant x fabric; odd counts differ by at most one. Otherwise it is
/// another fabric, each equally often.
std::vector<std::vector<Tray>> drawSameDifferentTrays(const std::vector<std::vector<Rendering>>& orders, const StudySize& size,
                                                      Random& random);

/// Inserts `count` catch trials into one participant's list of one phase. Each of `count` equal stretches gets one at a random
/// place. A catch trial is never first, and its fabric is never the true one before or after it.
std::vector<DesignTrial> withCatchTrials(const std::vector<DesignTrial>& trials, const Phase& phase, int fabrics, int count,
                                         Random& random);

/// Draws the anchors of one phase, participant by participant. They are even over the study: images and trays of mismatched
/// presentations, conditions and fabrics of repeated ones.
class AnchorDraws {
public:
    /// `blockLength`: presentations between two breaks.
    AnchorDraws(const Phase& phase, const StudySize& size, int blockLength, Random random);

    /// One participant's list with anchors; the others keep their order. Each of equal stretches of the list gets one mismatched
    /// presentation, and none is first. At least `blockLength` others lie between a presentation and its repetition, or half of
    /// the list where it is shorter, and always one. So a break lies between them where the list has one. Pieces of a repeated
    /// choice lie in slots drawn anew, so that a habit for a slot does not look like agreement. Neighbours have other labels, and
    /// in phases of ratings other fabrics, where that is possible. In choice phases the fabrics of neighbours are not looked at:
    /// a rule about the true one would tell it.
    std::vector<DesignTrial> with(const std::vector<DesignTrial>& trials);

private:
    /// How often each label, fabric and rendering was repeated over the study.
    struct Uses {
        std::vector<std::size_t> ofLabel, ofFabric, ofRendering;

        std::size_t renderingOf(const DesignTrial& trial) const;
        /// Conditions count more than fabrics, and these more than the rendering.
        std::size_t of(const DesignTrial& trial) const;
        void add(const DesignTrial& trial);
        /// The lower, the more even.
        std::size_t unevenness() const;
    };
    struct Drawn {
        std::vector<DesignTrial> list;
        Uses uses;
    };

    /// What a draw of the repetitions insists on.
    enum class Rule {
        Spread,      ///< one repetition in each stretch, and neighbours differ
        Neighbours,  ///< repetitions anywhere, and neighbours differ
        Places,      ///< one repetition in each stretch
    };

    void addMismatched(std::vector<DesignTrial>& list);
    void addRepeated(std::vector<DesignTrial>& list);
    std::optional<Drawn> evenest(const std::vector<DesignTrial>& list, std::size_t gap, Rule rule);
    std::optional<Drawn> tryRepeats(const std::vector<DesignTrial>& list, std::size_t gap, Rule rule);
    std::vector<std::size_t> drawPlaces(std::size_t room, Rule rule);
    std::optional<std::size_t> originalFor(const Drawn& drawn, const std::vector<bool>& used, std::size_t at, std::size_t gap,
                                           Rule rule);
    bool mayStandBeside(const DesignTrial& trial, const std::vector<DesignTrial>& list, std::size_t at) const;
    DesignTrial repetitionOf(const DesignTrial& trial);

    Phase m_phase;
    StudySize m_size;
    std::size_t m_blockLength;
    Random m_random;
    std::vector<int> m_images;               ///< fabrics that are left of the present round
    std::vector<std::vector<int>> m_others;  ///< [fabric of the image]: other fabrics that are left of the present round
    Uses m_uses;
};

}  // namespace protocols
