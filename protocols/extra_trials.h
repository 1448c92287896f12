// Draws the pieces and the places of presentations beside those of the conditions: catch trials (blank glass) and anchors.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/running_orders.h"
#include "protocols/trays.h"

namespace protocols {

/// What is known of the tray while these draws are made: its one piece, or the true fabric where foils come later.
int pieceOf(const DesignTrial& trial);

/// Deals the pieces of additional presentations (catch trials, anchors) to each participant. Where the tray holds one piece,
/// each then lies there equally often, or once more, whatever the kind of presentation. The pieces that lie once more change from
/// participant to participant. So the number of a piece's trays does not tell one kind from another. Where there are fewer
/// additional presentations than fabrics, a piece may have none, and shows this.
class ExtraPieces {
public:
    ExtraPieces(const Phase& phase, const StudySize& size, Random random);

    struct Dealt {
        std::vector<int> repeated, mismatched, caught;
    };
    /// Of the next participant.
    Dealt next();

private:
    std::vector<int> nextPieces(int count);
    /// Those that this participant, then the study (`uses`), has least.
    std::vector<int> take(std::vector<int>& pieces, int count, int mostOfEach, std::vector<int>& uses) const;

    Phase m_phase;
    StudySize m_size;
    Random m_random;
    std::vector<int> m_left;                    ///< pieces that are left of the round of those that lie once more
    std::vector<int> m_repeated, m_mismatched;  ///< [fabric]: over the study
};

/// Inserts a catch trial with each of the pieces into one participant's list of one phase. Each of equal stretches gets one at a
/// random place. A catch trial is never first, and its piece is not that before or after it where this can be. Lists without
/// trays get catch trials without trays.
std::vector<DesignTrial> withCatchTrials(const std::vector<DesignTrial>& trials, std::vector<int> pieces, Random& random);

/// Draws the anchors of one phase, participant by participant. They are nearly even over the study: images of mismatched
/// presentations, conditions of repeated ones, and the pieces of both.
class AnchorDraws {
public:
    /// `blockLength`: presentations between two breaks.
    AnchorDraws(const Phase& phase, const StudySize& size, int blockLength, Random random);

    /// One participant's list with anchors; the others keep their order. Each of equal stretches of the list gets one mismatched
    /// presentation, and none is first. At least `blockLength` others lie between a presentation and its repetition, or half of
    /// the list where it is shorter, and always one. So a break lies between them where the list has one. Neighbours have other
    /// labels and fabrics where that is possible, as in the list itself. A repeated presentation keeps its tray; in choice phases
    /// the lists have no trays yet, and each presentation gets its own (trays.h).
    std::vector<DesignTrial> with(const std::vector<DesignTrial>& trials, const ExtraPieces::Dealt& pieces);

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
        std::vector<int> left;  ///< [piece]: repetitions that are still due

        void add(const DesignTrial& repeated)
        {
            uses.add(repeated);
            --left[static_cast<std::size_t>(pieceOf(repeated))];
        }
    };

    /// What a draw of the repetitions insists on.
    enum class Rule {
        Spread,      ///< one repetition in each stretch, and neighbours differ
        Neighbours,  ///< repetitions anywhere, and neighbours differ
        Places,      ///< one repetition in each stretch
    };

    std::vector<int> drawImages(const std::vector<int>& pieces);
    void addMismatched(std::vector<DesignTrial>& list, const std::vector<int>& pieces);
    void addRepeated(std::vector<DesignTrial>& list, const std::vector<int>& pieces);
    std::optional<Drawn> evenest(const std::vector<DesignTrial>& list, const std::vector<int>& left, std::size_t gap, Rule rule);
    std::optional<Drawn> tryRepeats(const std::vector<DesignTrial>& list, const std::vector<int>& left, std::size_t gap,
                                    Rule rule);
    std::vector<std::size_t> drawPlaces(std::size_t room, Rule rule);
    std::optional<std::size_t> originalFor(const Drawn& drawn, const std::vector<bool>& used, std::size_t at, std::size_t gap,
                                           Rule rule);
    bool mayStandBeside(const DesignTrial& trial, const std::vector<DesignTrial>& list, std::size_t at) const;
    static DesignTrial repetitionOf(const DesignTrial& trial);

    Phase m_phase;
    StudySize m_size;
    std::size_t m_blockLength;
    Random m_random;
    std::size_t m_repeats = 0;          ///< of the present participant
    std::vector<std::size_t> m_images;  ///< [fabric]: mismatched presentations of its image over the study
    std::vector<std::size_t> m_pairs;   ///< [fabric of the image][piece]: the same of each pair
    Uses m_uses;
};

}  // namespace protocols
