// Turns a design over abstract labels into the contents of a study folder. Blinded trial lists hold file codes and presentation
// codes. The allocation key holds the fabric and condition of each file code; the masked key its fabric and K-label only.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace protocols {

/// One presentation as the session and the app know it.
struct BlindedTrial {
    TrialNumber number;
    int phase = 0;  ///< index into Protocol::phases
    FileCode fileCode;
    PresentationCode presentationCode;
    std::vector<FabricId> alternatives;  ///< on the tray, in slot order; one fabric in rating phases
    bool operator==(const BlindedTrial&) const = default;
};

/// File code -> condition and fabric. Only scripted and simulated participants and the recorded unblinding may read it.
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

/// File code -> fabric and K-label. Report, status and export may read it.
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
    AllocationKey key;                                    ///< with the catch trials, labelled "catch"
    std::vector<SwatchLabels> swatches;                   ///< [slot]
    std::vector<FileCode> familiarisation;                ///< images that no trial shows
};

/// `fabrics`: those of the study, in the order of the design's numbers. `secretSeed` draws the condition of each label, the file
/// codes, the K-labels and the presentation codes; outside tests it comes from drawSecretSeed(). `familiarisation`: number of
/// images that let the participant get to know the display.
Allocation allocate(const Protocol& protocol, const Design& design, const std::vector<FabricId>& fabrics,
                    std::uint64_t secretSeed, int familiarisation = 0);

/// The code of a presentation that is repeated after a void. It has the same form, differs from every code of the list, and is
/// the same in every call. `attempt` counts from 1; the first attempt has the trial's own code.
PresentationCode codeOfAttempt(const std::vector<BlindedTrial>& list, std::size_t index, int attempt);

MaskedKey masked(const AllocationKey& key);

}  // namespace protocols
