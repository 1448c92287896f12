// The balance that a design reached, as a certificate. It is counted on the design itself and shares nothing with the searches
// that drew it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/protocol.h"

namespace protocols {

/// Catch trials are left out. The number of participants is the design's.
struct BalanceCertificate {
    /// The least and the greatest count of something that should be even.
    struct Range {
        std::string what;  ///< "ordered pairs of conditions, Q1"
        int min = 0;
        int max = 0;
        bool operator==(const Range&) const = default;
    };
    std::vector<Range> ranges;
    int immediateRepeats = 0;   ///< same label or same fabric twice in a row
    int repeatedFoilPairs = 0;  ///< within participant x true fabric
    bool operator==(const BalanceCertificate&) const = default;
};

/// Balance of a planned design, or of what was presented.
BalanceCertificate balanceOf(const Design& design, const Protocol& protocol);

/// "balance", "immediate_repeats" and "repeated_foil_pairs".
nlohmann::ordered_json jsonOf(const BalanceCertificate& certificate);

/// The certificate in lines for people.
std::string describe(const BalanceCertificate& certificate);

}  // namespace protocols
