// From a design over abstract labels to what a study folder holds: blinded trial lists (file codes
// and presentation codes), the allocation key that says what each file code is, and the masked key
// that says only its fabric and K-label.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace protocols {

/// One presentation as session and app know it.
struct BlindedTrial {
    TrialNumber number;
    int phase = 0;  ///< index into Protocol::phases
    FileCode fileCode;
    PresentationCode presentationCode;
    std::vector<FabricId> alternatives;  ///< on the tray, in slot order; the one fabric in rating phases
    bool operator==(const BlindedTrial&) const = default;
};

/// File code -> condition and fabric. Only scripted and simulated participants and the recorded act
/// of unblinding may read it.
struct AllocationKey {
    struct Entry {
        FabricId fabric;
        ConditionId condition;
        ConditionLabel label;
        bool operator==(const Entry&) const = default;
    };
    std::map<FileCode, Entry> entries;
    bool operator==(const AllocationKey&) const = default;
};

/// File code -> fabric and K-label: what report, status and export may read.
struct MaskedKey {
    struct Entry {
        FabricId fabric;
        ConditionLabel label;
        bool operator==(const Entry&) const = default;
    };
    std::map<FileCode, Entry> entries;
    bool operator==(const MaskedKey&) const = default;
};

/// The neutral codes on the fabric pieces: three digits, all different on one tray.
using SwatchLabels = std::map<FabricId, std::string>;

struct Allocation {
    std::vector<std::vector<BlindedTrial>> participants;  ///< [slot][presentation]
    AllocationKey key;                                    ///< catch trials among them, labelled "catch"
    std::vector<SwatchLabels> swatches;                   ///< [slot]
    std::vector<FileCode> familiarisation;                ///< of images that no trial shows
};

/// `fabrics`: the study's, in the order of the design's numbers. `secretSeed` draws which condition
/// each label is, the file codes, the K-labels and the presentation codes; it comes from
/// drawSecretSeed() except in tests. `familiarisation`: how many images for getting to know the display.
Allocation allocate(const Protocol& protocol, const Design& design, const std::vector<FabricId>& fabrics,
                    std::uint64_t secretSeed, int familiarisation = 0);

/// The code of a presentation that is given again after a void: of the same form, other than every code
/// of the list, and the same whenever it is asked for. `attempt` counts from 1, whose code is the trial's.
PresentationCode codeOfAttempt(const std::vector<BlindedTrial>& list, std::size_t index, int attempt);

MaskedKey masked(const AllocationKey& key);

}  // namespace protocols
