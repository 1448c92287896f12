// The balance that a design reached, as a certificate. It is counted on the design itself and shares nothing with the searches
// that drew it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol.h"

namespace protocols {

/// Catch trials and anchors are left out, except from the handling of the pieces, and from pairs and stretches of the pieces that
/// lie alone on the trays of ratings. The number of participants is the design's.
struct BalanceCertificate {
    /// The least and the greatest count of something that should be even.
    struct Range {
        std::string what;  ///< "ordered pairs of conditions, Q1"
        int min = 0;
        int max = 0;
        bool operator==(const Range&) const = default;
    };
    /// What the operator does with the pieces from one tray to the next, as a mean over the presentations after the first.
    struct Handling {
        std::string phase;       ///< "Q1"
        double piecesPutOn = 0;  ///< each in place of one that is taken off
        double piecesMoved = 0;  ///< to another slot
        bool operator==(const Handling&) const = default;
    };
    std::vector<Range> ranges;
    std::vector<Handling> handling;  ///< of each phase; none where a participant has one presentation
    int immediateRepeats = 0;        ///< same label or same fabric twice in a row, of more than two
    int repeatedFoilPairs = 0;       ///< within participant x true fabric
    bool operator==(const BalanceCertificate&) const = default;
};

/// Balance of a planned design, or of what was presented.
BalanceCertificate balanceOf(const Design& design, const Protocol& protocol);

/// Mark of a balance that is not the study's own.
inline constexpr const char* balanceOfOthers = "other designs by the same rules";

/// Balance of three designs that this version draws for the protocol (of one, for more than 5000 presentations): the least and
/// the greatest counts of all. It tells what the rules reach. Exact counts of a study's own design would name true pieces.
BalanceCertificate balanceOfExamples(const Protocol& protocol);

/// "balance", "pieces_per_presentation", "immediate_repeats" and "repeated_foil_pairs".
nlohmann::ordered_json jsonOf(const BalanceCertificate& certificate);

/// The certificate in lines for people.
std::string describe(const BalanceCertificate& certificate);

/// The lines that differ between two designs of one protocol: "true slots per condition, Q1: 16 to 30 (even slots: 23 to 24)".
std::string describePrice(const BalanceCertificate& fewSwaps, const BalanceCertificate& evenSlots);

}  // namespace protocols
